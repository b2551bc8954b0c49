//! The schema of `claims.json`.

use serde_json::{Value, json};

use crate::claims::{Class, Kind, Verdict};

/// The form of `claims.json`, by JSON Schema of 2020-12.
pub(super) fn schema() -> Value {
    let verdict = json!({"enum": Verdict::ALL});
    let count = json!({"type": "integer", "minimum": 0});
    let cases = json!({"type": "object", "additionalProperties": false, "required": ["holding", "tried"],
        "properties": {"holding": count, "tried": count}});
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Numbers and statements of Liu, Friend and Yeo, Phys. Rev. E 80, 046201 (2009), compared with ours",
        "type": "array",
        "items": {"type": "object", "additionalProperties": false,
            "required": ["id", "place", "quantity", "unit", "printed", "computed", "tolerance", "verdict", "class",
                "note", "code", "provenance"],
            "properties": {
                "id": {"type": "string", "description": "The figure or table that answers it."},
                "place": {"type": "string", "description": "Where the paper prints it."},
                "quantity": {"type": "string", "description": "The quantity, or the statement in words."},
                "unit": {"type": "string", "description": "Of both numbers; empty for a pure number."},
                "printed": {"type": "string", "description": "The number as printed; \"true\" for a statement."},
                "computed": {"type": ["number", "boolean", "string", "null"],
                    "description": "Our number, whether the statement holds, or in how many cases; null: none."},
                "tolerance": {"type": ["number", "null"], "description": "The largest difference that counts as agreement."},
                "verdict": verdict,
                "class": {"enum": Class::ALL, "description": "Only \"paper\" counts for or against the paper."},
                "kind": {"enum": Kind::ALL, "description": "The rule that decides the verdict (docs/reproducing.md)."},
                "cause": {"type": "string", "description": "Why it differs; rows with one cause have one reason."},
                "share": {"type": "number", "minimum": 0, "maximum": 1,
                    "description": "Of the inputs that print alike, or of single orbits, for which it holds."},
                "single_orbits": {"type": "object", "additionalProperties": false, "required": ["verdict", "cases"],
                    "description": "The second verdict on a motor.",
                    "properties": {"verdict": verdict, "cases": cases}},
                "note": {"type": "string", "description": "Evidence and remarks."},
                "key": {"type": "string", "description": "The printed text: the entry NAME of data/paper/FILE.json, as FILE.NAME."},
                "code": {"type": "string", "description": "File and line of the code that states the claim."},
                "provenance": {"type": "object", "required": ["program", "version", "parameters"],
                    "description": "The program that computed it, and the quality of the figure."},
            },
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Cases, Claim};

    #[test]
    fn the_schema_has_every_field() {
        let full = Claim::printed("section4.doubling_1", 0.6).cause("a \"misprint\", it seems");
        let full = full.single_orbits(Cases { holding: 3, tried: 4 }).note("first\nsecond");
        let claims = [full, Claim::statement("fig06", "", "ours", None, "")];
        let claims = claims.map(|claim| {
            let mut claim = serde_json::to_value(claim).expect("finite");
            claim["provenance"] = json!({"parameters": {"quality": "draft"}, "program": "p", "version": "1"});
            claim
        });
        let form = &schema()["items"];
        let names =
            |object: &Value| object.as_object().map(|object| object.keys().cloned().collect::<Vec<_>>());
        assert_eq!(names(&claims[0]), names(&form["properties"]));
        let required: Vec<_> =
            form["required"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
        let mut smallest = names(&claims[1]).expect("an object");
        smallest.retain(|name| !required.contains(&name.as_str()));
        assert!(
            smallest.is_empty() && required.iter().all(|name| claims[1].get(name).is_some()),
            "{smallest:?}"
        );
        assert_eq!(form["properties"]["verdict"]["enum"][2], "depends-on-unprinted-digits");
    }
}
