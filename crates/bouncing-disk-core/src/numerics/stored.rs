//! Deserialisation through the same checks as construction.

/// Deserialises a type through its checks. A mirror struct requires each of its fields (except optional ones)
/// and accepts no other. Then `check` runs on the value, or the constructor named after `=>` makes it.
///
/// `Error` is resolved in the calling module. Without the feature `serde` nothing reads the mirror; it is
/// still compiled, so that checks and imports need no condition.
#[doc(hidden)]
#[macro_export]
macro_rules! read_checked {
    (@mirror $mirror:ident $(<$of:ident>)? {
        $($(#[$attribute:meta])* $field:ident: $kind:ty),+
    }) => {
        #[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(deny_unknown_fields))]
        #[cfg_attr(not(feature = "serde"), allow(dead_code, reason = "only what is read has this form"))]
        struct $mirror $(<$of>)? {
            $($(#[cfg_attr(feature = "serde", $attribute)])* $field: $kind,)+
        }
    };
    (enum $type:ident as $mirror:ident {
        $($variant:ident
            $(($($place:ident: $of:ty),+))?
            $({ $($(#[$attribute:meta])* $field:ident: $kind:ty),+ $(,)? })?
        ),+ $(,)?
    }) => {
        #[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(deny_unknown_fields))]
        #[cfg_attr(not(feature = "serde"), allow(dead_code, reason = "only what is read has this form"))]
        enum $mirror {
            $($variant
                $(($($of),+))?
                $({ $($(#[cfg_attr(feature = "serde", $attribute)])* $field: $kind),+ })?
            ,)+
        }

        impl TryFrom<$mirror> for $type {
            type Error = Error;

            fn try_from(read: $mirror) -> Result<Self, Error> {
                let value = match read {
                    $($mirror::$variant $(($($place),+))? $({ $($field),+ })? =>
                        Self::$variant $(($($place),+))? $({ $($field),+ })?,)+
                };
                value.check()?;
                Ok(value)
            }
        }
    };
    ($type:ident $(<$of:ident>)? as $mirror:ident {
        $($(#[$attribute:meta])* $field:ident: $kind:ty),+ $(,)?
    }) => {
        $crate::read_checked!(@mirror $mirror $(<$of>)? { $($(#[$attribute])* $field: $kind),+ });

        impl $(<$of>)? TryFrom<$mirror $(<$of>)?> for $type $(<$of>)? {
            type Error = Error;

            fn try_from(read: $mirror $(<$of>)?) -> Result<Self, Error> {
                let value = Self { $($field: read.$field,)+ };
                value.check()?;
                Ok(value)
            }
        }
    };
    ($type:ident as $mirror:ident {
        $($(#[$attribute:meta])* $field:ident: $kind:ty),+ $(,)?
    } => $make:path) => {
        $crate::read_checked!(@mirror $mirror { $($(#[$attribute])* $field: $kind),+ });

        impl TryFrom<$mirror> for $type {
            type Error = Error;

            fn try_from(read: $mirror) -> Result<Self, Error> {
                $make($(read.$field),+)
            }
        }
    };
}
pub(crate) use read_checked;

/// Reads a number that may be infinite. JSON has no such number and stores `null` instead. Other text formats
/// (RON, TOML) have no `null`: reading back is guaranteed only for JSON and binary formats such as CBOR.
///
/// # Errors
/// Errors of the format.
#[cfg(feature = "serde")]
pub fn infinite_if_none<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    or_else(from, f64::INFINITY)
}

/// Reads a number that may be NaN (0/0). JSON stores `null` instead.
///
/// # Errors
/// Errors of the format.
#[cfg(feature = "serde")]
pub fn nan_if_none<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    or_else(from, f64::NAN)
}

#[cfg(feature = "serde")]
fn or_else<'de, D: serde::Deserializer<'de>>(from: D, missing: f64) -> Result<f64, D::Error> {
    use serde::Deserialize as _;
    // A binary format stores every number, and cannot store the absence of one.
    if from.is_human_readable() {
        Ok(Option::deserialize(from)?.unwrap_or(missing))
    } else {
        f64::deserialize(from)
    }
}
