//! The builder methods that layers share, written once.

/// Writes those of the shared builder methods that a layer names. The methods set parts of its field `style`
/// (a [`Style`](crate::style::Style), or for words a [`TextStyle`](crate::text_style::TextStyle)) or its
/// field `name`.
macro_rules! builders {
    ($layer:ident: $($method:ident),+) => {
        impl $layer {
            $(builders!(@$method);)+
        }
    };
    (@style) => {
        /// Sets the line and the area at once.
        #[must_use]
        pub fn style(mut self, style: impl Into<$crate::style::Style>) -> Self {
            self.style = style.into();
            self
        }
    };
    (@stroke) => {
        /// Sets colour, width, dashes and opacity of the line.
        #[must_use]
        pub fn stroke(mut self, stroke: $crate::style::Stroke) -> Self {
            self.style = self.style.stroke(stroke);
            self
        }
    };
    (@colour) => {
        /// Sets the colour.
        #[must_use]
        pub fn colour(mut self, colour: $crate::colour::Colour) -> Self {
            self.style = self.style.colour(colour);
            self
        }
    };
    (@width) => {
        /// Sets the width of the line in points.
        #[must_use]
        pub fn width(mut self, points: f64) -> Self {
            self.style = self.style.width(points);
            self
        }
    };
    (@dash) => {
        /// Sets the dashes of the line.
        #[must_use]
        pub fn dash(mut self, dash: $crate::style::Dash) -> Self {
            self.style = self.style.dash(dash);
            self
        }
    };
    (@opacity) => {
        /// Sets the opacity, 0 to 1.
        #[must_use]
        pub fn opacity(mut self, opacity: f64) -> Self {
            self.style = self.style.opacity(opacity);
            self
        }
    };
    (@name) => {
        /// Lists the layer in the legend.
        #[must_use]
        pub fn name(mut self, name: impl Into<$crate::label::Label>) -> Self {
            self.name = Some(name.into());
            self
        }
    };
}

pub(crate) use builders;
