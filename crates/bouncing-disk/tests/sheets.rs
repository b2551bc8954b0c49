//! The JSON schemas of sheets (`data/sheets`) hold what the readers take, and no more: they are made by asking the
//! readers. `UPDATE_DOCUMENTATION=1` writes them.
#![cfg(feature = "toml")]

use std::fs;
use std::path::{Path, PathBuf};

use bouncing_disk::motor::{MotorField, MotorFileError, MotorParameters};
use bouncing_disk::parameters::{Contact, DriveParameters, LoadLaw, StatorParameters};
use bouncing_disk::sheet_text::{from_json, from_toml};
use bouncing_disk::{DiskParameters, Error, Motor, PlatformParameters, System};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

/// Whether a value has the wrong type, or a name in it is wrong. Whether a number is legal is another question.
fn is_of_form(reason: &str) -> bool {
    let words = [
        "invalid type",
        "invalid length",
        "expected value",
        "missing field",
        "is unknown",
        "is not a shape",
        "is not a key",
    ];
    words.iter().any(|words| reason.contains(words))
}

/// Why a reader takes no such value.
fn refusal<T: DeserializeOwned>(sheet: &Value) -> Option<String> {
    from_json::<T>(&sheet.to_string()).err().map(|error| error.reason).filter(|reason| is_of_form(reason))
}

/// The words or keys that a reader lists when it is given another one.
fn known(refusal: Option<String>) -> Option<Vec<Value>> {
    let reason = refusal?;
    let (_, words) = reason.split_once("the known ones are ")?;
    Some(words.split(", ").map(Value::from).collect())
}

fn object(required: &[String], properties: &Map<String, Value>) -> Value {
    json!({"type": "object", "additionalProperties": false, "required": required, "properties": properties})
}

/// The form of a table, as its reader has it; `place` is what stands before its keys.
fn table<T: DeserializeOwned>(place: &str) -> Value {
    let (mut needed, mut required) = (Map::new(), Vec::new());
    while let Some(reason) = refusal::<T>(&needed.clone().into()) {
        let key = reason.split('`').nth(1).expect("a missing field").to_owned();
        needed.insert(key.clone(), json!(0.5));
        required.push(key);
    }
    let keys = known(refusal::<T>(&json!({"?": 1}))).expect("a table");
    let mut properties = Map::new();
    for key in keys.iter().filter_map(Value::as_str) {
        let read = |value: Value| {
            let mut sheet = needed.clone();
            sheet.insert(key.to_owned(), value);
            refusal::<T>(&sheet.into())
        };
        if !read(json!(0.5)).is_some_and(|reason| reason.contains("is not a key")) {
            properties.insert(key.to_owned(), form(&format!("{place}{key}"), read));
        }
    }
    object(&required, &properties)
}

/// The form of a value.
fn form(path: &str, read: impl Fn(Value) -> Option<String>) -> Value {
    let number = || json!({"type": "number"});
    let is_optional = read(Value::Null).is_none();
    let mut form = match path {
        "contact" => table::<Contact>("contact."),
        "stator" => table::<StatorParameters>("stator."),
        "load" => table::<LoadLaw>("load."),
        "drive" => table::<DriveParameters>("drive."),
        "drive.height" | "drive.angle" => {
            let only =
                |key: &str, form: Value| object(&[key.to_owned()], &Map::from_iter([(key.to_owned(), form)]));
            let pair = |second: Value| json!({"type": "array", "prefixItems": [number(), second], "minItems": 2, "maxItems": 2});
            let list = |of: Value| json!({"type": "array", "items": of});
            let coefficients = json!({"type": "array", "items": number(), "maxItems": 4});
            json!({"anyOf": [
                {"enum": ["sine", "triangle", "parabolas", "cubics"]},
                only("sawtooth", number()),
                only("fourier", list(pair(number()))),
                only("pieces", list(pair(coefficients))),
                only("sampled", list(number())),
            ]})
        }
        _ if read(json!(0.5)).is_none() => number(),
        _ => match (known(read(json!("?"))), known(read(json!(["?", "?"])))) {
            (Some(words), _) => json!({"enum": words}),
            (_, Some(words)) => {
                json!({"type": "array", "items": {"enum": words}, "minItems": 2, "maxItems": 2})
            }
            _ => json!({"type": "array", "items": number()}),
        },
    };
    if let Some(field) = MotorField::ALL.into_iter().find(|field| field.name() == path) {
        form["description"] = format!("Unit: {}.", field.unit()).into();
    }
    if is_optional {
        if let Some(words) = form.get_mut("enum").and_then(Value::as_array_mut) {
            words.push(Value::Null);
        } else if form["type"].is_string() {
            form["type"] = json!([form["type"], "null"]);
        }
    }
    form
}

fn titled(title: &str, mut form: Value) -> Value {
    form["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    form["title"] = title.into();
    form
}

fn motor_schema() -> Value {
    let mut form = table::<MotorParameters>("");
    let required = form["required"].as_array().expect("a list").clone();
    for (key, form) in form["properties"].as_object_mut().expect("a table") {
        // Nothing in place of a number is the same as no key; in place of a table it is not.
        match form["type"][0].as_str() {
            Some("object") => form["type"] = "object".into(),
            None if form["type"] == "number" && !required.contains(&json!(key)) => {
                form["type"] = json!(["number", "null"])
            }
            _ => {}
        }
    }
    titled("The data sheet of a motor (docs/designing-a-motor.md), in SI units", form)
}

fn system_schema() -> Value {
    let mut properties = Map::from_iter([
        ("platform".to_owned(), table::<PlatformParameters>("platform.")),
        ("disk".to_owned(), table::<DiskParameters>("disk.")),
        ("drive".to_owned(), table::<DriveParameters>("drive.")),
    ]);
    let nothing = |_| None;
    properties.insert("contact".to_owned(), form("contact", nothing));
    properties.insert("stator".to_owned(), form("stator", nothing));
    let form = object(&["platform".to_owned(), "disk".to_owned()], &properties);
    titled("A disk on a platform, as the command line reads it (docs/command-line.md), in SI units", form)
}

/// Whether a value has this form: of JSON Schema that which the schemas here need.
fn is_valid(form: &Value, value: &Value) -> bool {
    let list = |key: &str| form.get(key).and_then(Value::as_array);
    if let Some(forms) = list("anyOf") {
        return forms.iter().any(|form| is_valid(form, value));
    }
    if let Some(words) = list("enum") {
        return words.contains(value);
    }
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let is_kind = form["type"] == kind || list("type").is_some_and(|kinds| kinds.contains(&kind.into()));
    let bound = |key: &str| form.get(key).and_then(Value::as_u64);
    is_kind
        && match value {
            Value::Array(items) => {
                let count = items.len() as u64;
                let prefix = list("prefixItems");
                bound("minItems").is_none_or(|least| least <= count)
                    && bound("maxItems").is_none_or(|most| count <= most)
                    && prefix
                        .is_none_or(|forms| forms.iter().zip(items).all(|(form, own)| is_valid(form, own)))
                    && form.get("items").is_none_or(|form| items.iter().all(|own| is_valid(form, own)))
            }
            Value::Object(own) => {
                let properties = form["properties"].as_object().expect("a table");
                let is_own = |(key, value): (&String, &Value)| {
                    properties.get(key).is_some_and(|form| is_valid(form, value))
                };
                own.iter().all(is_own)
                    && list("required").is_none_or(|keys| {
                        keys.iter().filter_map(Value::as_str).all(|key| own.contains_key(key))
                    })
            }
            _ => true,
        }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn the_schemas_are_those_of_the_readers() {
    for (name, schema) in [("motor", motor_schema()), ("system", system_schema())] {
        let path = root().join(format!("data/sheets/{name}.schema.json"));
        let text = serde_json::to_string_pretty(&schema).expect("writes") + "\n";
        if std::env::var_os("UPDATE_DOCUMENTATION").is_some() {
            fs::write(&path, text).expect("writes");
        } else {
            let stored = fs::read_to_string(&path).expect("reads");
            assert!(stored == text, "{}: UPDATE_DOCUMENTATION=1 writes it", path.display());
        }
    }
    let schema = motor_schema();
    for field in MotorField::ALL {
        let path = format!("/properties/{}", field.name().replace('.', "/properties/"));
        assert!(schema.pointer(&path).is_some(), "{field}");
    }
}

fn value(toml: &str) -> Value {
    from_toml(toml).expect(toml)
}

#[test]
fn sheets_of_the_repository_are_valid() {
    let read = |path: &str| fs::read_to_string(root().join(path)).expect(path);
    let mut motors = vec![read("crates/bouncing-disk-cli/tests/data/0.1/motor.toml")];
    motors.extend([Motor::paper_70_khz(), Motor::paper_184_khz()].map(|motor| motor.to_toml()));
    let mut drives = Vec::new();
    for page in fs::read_dir(root().join("docs")).expect("docs").map(|page| page.expect("an entry").path()) {
        let text = if page.is_file() { fs::read_to_string(&page).unwrap_or_default() } else { String::new() };
        for sheet in text.split("```toml\n").skip(1).filter_map(|block| block.split("```").next()) {
            let list = if sheet.contains("drive_frequency") { &mut motors } else { &mut drives };
            list.push(sheet.to_owned());
        }
    }
    assert!(motors.len() > 2 && !drives.is_empty(), "{motors:?} {drives:?}");
    let schema = motor_schema();
    for sheet in motors {
        assert!(is_valid(&schema, &value(&sheet)) && Motor::from_toml(&sheet).is_ok(), "{sheet}");
    }
    let schema = system_schema();
    let toss = read("crates/bouncing-disk-cli/tests/data/0.1/toss.toml");
    drives.retain(|sheet| sheet.starts_with('['));
    for sheet in drives.iter().map(|drive| format!("{toss}{drive}")).chain([toss.clone()]) {
        assert!(is_valid(&schema, &value(&sheet)), "{sheet}");
    }
    assert!(is_valid(&schema, &serde_json::to_value(System::motor()).expect("writes")));
}

/// For each key and each kind of value the schema and the reader say the same.
#[test]
fn what_a_reader_refuses_by_type_or_name_is_not_valid() {
    let values = [
        json!(null),
        json!(0.5),
        json!("sine"),
        json!("?"),
        json!(true),
        json!([0.5]),
        json!([0.5, 0.5]),
        json!(["steel", "skin"]),
        json!({"?": 1}),
        json!({"sawtooth": 0.5}),
        json!({"pieces": [[0.5, [0, 1]], [0.5, [1, 2, 3, 4, 5]]]}),
    ];
    fn check(schema: &Value, whole: &Value, values: &[Value], refused: &dyn Fn(&Value) -> bool) {
        let keys = |form: &Value| {
            form["properties"].as_object().expect("a table").keys().cloned().collect::<Vec<_>>()
        };
        for key in keys(schema).into_iter().chain(["?".to_owned()]) {
            let form = &schema["properties"][&key];
            let inner = if form["properties"].is_object() { keys(form) } else { Vec::new() };
            let keyed = !inner.is_empty();
            let paths = inner.iter().map(|inner| Some(inner.as_str())).chain([None]);
            for (inner, own) in paths.flat_map(|inner| values.iter().map(move |own| (inner, own))) {
                let mut sheet = whole.clone();
                match inner {
                    Some(inner) if sheet[&key].is_object() => sheet[&key][inner] = own.clone(),
                    Some(inner) => sheet[&key] = json!({ inner: own }),
                    None => sheet[&key] = own.clone(),
                }
                // The readers also take the values of a table in their order, which is no sheet.
                let is_positional = keyed && inner.is_none() && own.is_array();
                let is_legal = !refused(&sheet) && !is_positional;
                assert_eq!(is_valid(schema, &sheet), is_legal, "{key}.{inner:?} = {own}");
            }
        }
    }
    let motor = serde_json::from_str(&Motor::paper_70_khz().to_json()).expect("reads");
    let schema = motor_schema();
    let is_needed =
        |field: &str| schema["required"].as_array().is_some_and(|keys| keys.contains(&field.into()));
    check(&schema, &motor, &values, &|sheet| match Motor::from_json(&sheet.to_string()) {
        Err(MotorFileError::Text { reason, .. }) => is_of_form(&reason),
        Err(MotorFileError::Illegal(Error::NotGiven { field })) => is_needed(field),
        _ => false,
    });
    let system = serde_json::to_value(System::pizza_toss()).expect("writes");
    check(&system_schema(), &system, &values, &|sheet| {
        let (mut rest, drive) = (sheet.clone(), sheet.get("drive"));
        rest.as_object_mut().expect("a table").remove("drive");
        refusal::<System>(&rest).is_some()
            || drive.is_some_and(|drive| refusal::<DriveParameters>(drive).is_some())
    });
}
