//! The file modelDescription.xml.

use std::fmt::Write as _;

use bouncing_disk::Motor;

use crate::variables::{Role, Variable, variables};

/// The name of the binary in the unit.
pub(crate) const IDENTIFIER: &str = "bouncing_disk_motor";

/// The units of the variables by their exponents.
const UNITS: &[(&str, &str)] = &[
    ("s", "s=\"1\""),
    ("Hz", "s=\"-1\""),
    ("rad", "rad=\"1\""),
    ("rad/s", "rad=\"1\" s=\"-1\""),
    ("rad/m", "rad=\"1\" m=\"-1\""),
    ("m", "m=\"1\""),
    ("m/s^2", "m=\"1\" s=\"-2\""),
    ("kg", "kg=\"1\""),
    ("kg/m^3", "kg=\"1\" m=\"-3\""),
    ("N", "kg=\"1\" m=\"1\" s=\"-2\""),
    ("N/m", "kg=\"1\" s=\"-2\""),
    ("N m", "kg=\"1\" m=\"2\" s=\"-2\""),
    ("V", "kg=\"1\" m=\"2\" s=\"-3\" A=\"-1\""),
    ("A", "A=\"1\""),
    ("W", "kg=\"1\" m=\"2\" s=\"-3\""),
];

/// The token by which an instance checks that it was made for this description: a hash (FNV-1a) of the data
/// sheet and the version.
pub(crate) fn token(sheet: &str) -> String {
    let hash = |basis: u64| {
        let bytes = sheet.bytes().chain(env!("CARGO_PKG_VERSION").bytes());
        bytes.fold(basis, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    };
    format!("{{{:016x}{:016x}}}", hash(0xcbf2_9ce4_8422_2325), hash(0x6c62_272e_07bb_0142))
}

/// The description of a motor.
pub(crate) fn description(motor: &Motor) -> String {
    let all = variables(motor);
    let token = token(&motor.to_json());
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<fmiModelDescription fmiVersion=\"3.0\" modelName=\"bouncing-disk motor\" instantiationToken=\"{token}\"
  description=\"An ultrasonic motor whose rotor bounces on its stator\" version=\"{version}\"
  generationTool=\"bouncing-disk {version}\" license=\"MIT OR Apache-2.0\" variableNamingConvention=\"structured\">
  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canHandleVariableCommunicationStepSize=\"true\"
    canGetAndSetFMUState=\"true\"/>
  <UnitDefinitions>
",
        version = env!("CARGO_PKG_VERSION"),
    );
    for (unit, exponents) in UNITS.iter().filter(|(unit, _)| all.iter().any(|known| known.unit == *unit)) {
        // Writing to a text cannot fail.
        let _ = writeln!(text, "    <Unit name=\"{unit}\"><BaseUnit {exponents}/></Unit>");
    }
    text += "  </UnitDefinitions>
  <LogCategories>
    <Category name=\"logStatusError\" description=\"Why a call failed\"/>
  </LogCategories>
  <DefaultExperiment startTime=\"0\" stopTime=\"1\" stepSize=\"0.001\"/>
  <ModelVariables>
";
    for (reference, variable) in all.iter().enumerate() {
        let Variable { name, unit, description, start, role } = variable;
        let kind = match role {
            Role::Time => "causality=\"independent\"".to_owned(),
            Role::Sheet(_) | Role::Setting(_) => {
                format!("causality=\"parameter\" variability=\"fixed\" start=\"{start:?}\"")
            }
            Role::Input(_) => format!("causality=\"input\" start=\"{start:?}\""),
            Role::Output(_) => "causality=\"output\" initial=\"calculated\"".to_owned(),
        };
        let unit = if *unit == "1" { String::new() } else { format!(" unit=\"{unit}\"") };
        let _ = writeln!(
            text,
            "    <Float64 name=\"{name}\" valueReference=\"{reference}\" {kind}{unit} description=\"{description}\"/>"
        );
    }
    text += "  </ModelVariables>\n  <ModelStructure>\n";
    for element in ["Output", "InitialUnknown"] {
        for reference in (0..all.len()).filter(|reference| matches!(all[*reference].role, Role::Output(_))) {
            let _ = writeln!(text, "    <{element} valueReference=\"{reference}\"/>");
        }
    }
    text + "  </ModelStructure>\n</fmiModelDescription>\n"
}
