//! The builder methods of all parts of a figure, written once.

/// Writes builder methods, each from its name, its arguments and its action on the value: `/// Doc.`,
/// `name(argument: Type) |own| own.field = argument;`.
///
/// Methods that several layers share need only their names. They set parts of a layer's field `style` (a
/// [`Style`](crate::style::Style) or a [`TextStyle`](crate::style::TextStyle)) or its field `name`.
macro_rules! builders {
    ($type:ident {
        $($(#[$doc:meta])* $method:ident($($argument:ident: $kind:ty),*) |$own:ident| $set:expr;)+
    }) => {
        impl $type {
            $($(#[$doc])*
            #[must_use]
            pub fn $method(mut self, $($argument: $kind),*) -> Self {
                let $own = &mut self;
                $set;
                self
            })+
        }
    };
    ($layer:ident: $($shared:ident),+) => {
        $(builders!(@$shared $layer);)+
    };
    (@style $layer:ident) => {
        builders!($layer {
            /// Sets the line and the area at once.
            style(style: impl Into<$crate::style::Style>) |own| own.style = style.into();
        });
    };
    (@stroke $layer:ident) => {
        builders!($layer {
            /// Sets colour, width, dashes and opacity of the line.
            stroke(stroke: $crate::style::Stroke) |own| own.style = own.style.stroke(stroke);
        });
    };
    (@colour $layer:ident) => {
        builders!($layer {
            /// Sets the colour.
            colour(colour: $crate::colour::Colour) |own| own.style = own.style.colour(colour);
        });
    };
    (@width $layer:ident) => {
        builders!($layer {
            /// Sets the width of the line in points.
            width(points: f64) |own| own.style = own.style.width(points);
        });
    };
    (@dash $layer:ident) => {
        builders!($layer {
            /// Sets the dashes of the line.
            dash(dash: $crate::style::Dash) |own| own.style = own.style.dash(dash);
        });
    };
    (@opacity $layer:ident) => {
        builders!($layer {
            /// Sets the opacity, 0 to 1.
            opacity(opacity: f64) |own| own.style = own.style.opacity(opacity);
        });
    };
    (@name $layer:ident) => {
        builders!($layer {
            /// Lists the layer in the legend.
            name(name: impl Into<$crate::label::Label>) |own| own.name = Some(name.into());
        });
    };
}

pub(crate) use builders;
