//! The table `[contact]` of a file: the duration of an impact, which makes contacts compliant, or materials
//! from which the duration is estimated.

pub(crate) mod estimate;

use crate::error::{Error, check, positive};

/// Defines the enum of materials and its table.
macro_rules! materials {
    ($($(#[$doc:meta])* $variant:ident: $low:literal, $high:literal, $poisson:literal;)*) => {
        /// A material, with the range of Young's modulus (GPa) covered by its name and one Poisson's ratio.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
        #[non_exhaustive]
        pub enum Material {
            $($(#[$doc])* $variant,)*
        }

        impl Material {
            /// Young's modulus (Pa), the least and the largest.
            #[must_use]
            pub const fn youngs_modulus(self) -> [f64; 2] {
                match self {
                    $(Self::$variant => [1.0e9 * $low, 1.0e9 * $high],)*
                }
            }

            /// Poisson's ratio.
            #[must_use]
            pub const fn poissons_ratio(self) -> f64 {
                match self {
                    $(Self::$variant => $poisson,)*
                }
            }
        }
    };
}

materials! {
    /// Carbon to stainless steels: Gere, Mechanics of Materials (5th ed.), tables of properties.
    Steel: 190.0, 210.0, 0.29;
    /// Aluminium alloys: Gere.
    Aluminium: 68.0, 73.0, 0.33;
    /// Gere.
    Brass: 96.0, 110.0, 0.34;
    /// Gere.
    Bronze: 96.0, 120.0, 0.34;
    /// Titanium alloys: Gere.
    Titanium: 100.0, 120.0, 0.33;
    /// Gere, all glasses.
    Glass: 48.0, 83.0, 0.22;
    /// Lead zirconate titanate, poled, along and across: orders of magnitude, not taken from a table.
    Pzt: 48.0, 90.0, 0.31;
    /// Film: `DuPont`, Kapton HN data sheet (2.5 GPa); up to 3 GPa for other films.
    Polyimide: 2.5, 3.0, 0.34;
    /// Cured, without filler: orders of magnitude, not taken from a table.
    Epoxy: 2.0, 4.0, 0.37;
    /// Gere; nearly incompressible, with a bulk modulus of 0.2 to 1.3 GPa.
    Rubber: 0.0007, 0.004, 0.4995;
    /// Wheat dough: three times a shear modulus of 1 to 30 kPa at small oscillations, depending on water and
    /// frequency; orders of magnitude, not taken from a table. Bubbles make it compressible.
    Dough: 3.0e-6, 1.0e-4, 0.45;
    /// Skin: from soft tissue (an order of magnitude, not taken from a table) to epidermis (Geerligs et al., J.
    /// Biomech. 44, 1176 (2011)).
    Skin: 5.0e-6, 2.0e-3, 0.45;
}

/// The geometry of the contact between disk and platform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Geometry {
    /// A ball, the disk, on a plane: needs [`Contact::ball_radius`].
    Plane,
    /// A ball on the edge of a ring: needs [`Contact::ball_radius`] and [`Contact::ring_radius`].
    Ring,
    /// Flat on flat with a layer of the softer material: needs [`Contact::area`] and [`Contact::thickness`].
    Layer,
}

/// How a compliant contact loses energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ContactLaw {
    /// A damper parallel to the spring.
    #[default]
    Damper,
    /// The spring unloads with its stiffness times the square of the restitution.
    Hysteresis,
}

/// The table `[contact]` of a file. With a time, contacts are compliant in all computations that support them
/// (tosses, motors); the others return an error. From materials, geometry and sizes, a range is estimated
/// instead: impacts stay rigid, and a report compares the range with the period. A system and a data sheet
/// check the table.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default, expecting = "the table contact"))]
pub struct Contact {
    /// Duration (s) of an isolated impact on a rigid platform, positive; replaces all other entries. Below
    /// 1e-6 rad of the platform's vibration, impacts are rigid, with a warning.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub time: Option<f64>,
    /// How the contact loses energy; only with a time.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub law: Option<ContactLaw>,
    /// Materials of the disk and of the platform.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub materials: Option<[Material; 2]>,
    /// Geometry of the contact; needed with materials.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub geometry: Option<Geometry>,
    /// Radius of the ball (m).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub ball_radius: Option<f64>,
    /// Radius of the circle on which the ball touches the ring (m), less than the ball's.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub ring_radius: Option<f64>,
    /// Area of the layer (m^2).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub area: Option<f64>,
    /// Thickness of the layer (m).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub thickness: Option<f64>,
    /// Combined root mean square height of both surfaces (m); smooth surfaces if absent.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub roughness: Option<f64>,
    /// Mass of the disk (kg): needed with materials, unless a data sheet states it.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub mass: Option<f64>,
    /// Speed of the impact (m/s), instead of the rigid model's.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub speed: Option<f64>,
}

impl Contact {
    /// The paper's motor: a steel ball of 20 mm on the edge of an aluminium stator (Secs. V A and V B).
    pub const PAPER: Self = Self {
        time: None,
        law: None,
        materials: Some([Material::Steel, Material::Aluminium]),
        geometry: Some(Geometry::Ring),
        ball_radius: Some(0.01),
        ring_radius: Some(1.25e-3),
        area: None,
        thickness: None,
        roughness: None,
        mass: None,
        speed: None,
    };

    /// An impact of this duration (s).
    #[must_use]
    pub fn lasting(time: f64) -> Self {
        Self { time: Some(time), ..Self::default() }
    }

    /// Checks the numbers, and that everything needed is given and nothing else. The mass is checked later.
    pub(crate) fn check(&self) -> Result<(), Error> {
        use Geometry::{Layer, Plane, Ring};
        let geometry = ("contact.geometry", self.geometry.is_some());
        let sizes: [(_, _, &[_]); 4] = [
            ("contact.ball_radius", self.ball_radius, &[Plane, Ring]),
            ("contact.ring_radius", self.ring_radius, &[Ring]),
            ("contact.area", self.area, &[Layer]),
            ("contact.thickness", self.thickness, &[Layer]),
        ];
        let others = [
            ("contact.roughness", self.roughness),
            ("contact.mass", self.mass),
            ("contact.speed", self.speed),
        ];
        let time = ("contact.time", self.time);
        let numbers = sizes.iter().map(|own| (own.0, own.1)).chain(others);
        for (field, value) in numbers.clone().chain([time]) {
            value.map(|value| positive(field, value)).transpose()?;
        }
        let materials = ("contact.materials", self.materials.is_some());
        if self.time.is_some() {
            let rest = numbers.map(|(field, value)| (field, value.is_some()));
            return match [materials, geometry].into_iter().chain(rest).find(|(_, given)| *given) {
                Some((other, _)) => Err(Error::BothGiven { one: "contact.time", other }),
                None => Ok(()),
            };
        }
        if self.law.is_some() {
            return Err(Error::NotGiven { field: "contact.time" });
        }
        if !materials.1 {
            return Err(Error::NeitherGiven { one: "contact.time", other: "contact.materials" });
        }
        let geometry = self.geometry.ok_or(Error::NotGiven { field: "contact.geometry" })?;
        for (field, value, needed_by) in sizes {
            match value {
                None if needed_by.contains(&geometry) => return Err(Error::NotGiven { field }),
                Some(_) if !needed_by.contains(&geometry) => {
                    return Err(Error::BothGiven { one: "another geometry", other: field });
                }
                _ => {}
            }
        }
        if let (Some(ring), Some(ball)) = (self.ring_radius, self.ball_radius) {
            check(ring < ball, "contact.ring_radius", ring, "less than contact.ball_radius")?;
        }
        Ok(())
    }
}
