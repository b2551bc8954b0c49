//! Chunks and their merge: the same bytes as without, and a refusal of foreign parts by name.

use crate::common::{Folder, no_part};

/// A quick line of each command that can be divided, with its number of rows.
const GRIDS: [(&str, usize); 6] = [
    ("diagram -G 0.3:0.6:7 --transient 50 --recorded 20", 7),
    ("verdicts -G 0.3:0.6:5 --impacts 500 --transient 100", 5),
    ("verdicts -G 0:1:6 -r 0:0.9:4 --impacts 500 --transient 100 --start period-1", 4),
    ("basins -G 0.486 --cells 9 --starts 20 --impacts 300", 9),
    (
        "motor sweep --over friction=0.1:0.2:2 --over amplitude=1e-8:3e-8:3 --relative-error 0.3 --members 4",
        3,
    ),
    ("motor transient --members 6 --duration 3 --intervals 30", 6),
];

fn parts(folder: &Folder, line: &str, count: usize) -> String {
    let names: Vec<String> = (1..=count)
        .map(|index| {
            let name = format!("part-{index}-of-{count}.json");
            folder.done(&format!("{line} --chunk {index}/{count} --out {name} --force"));
            name
        })
        .collect();
    names.join(" ")
}

#[test]
fn parts_are_put_together_to_the_bytes_of_the_whole() {
    let folder = Folder::new();
    for (line, rows) in GRIDS {
        let text = folder.done(line);
        folder.done(&format!("{line} --out whole.json --out whole.csv --out whole.svg --force"));
        // One part, some, one a row, and more than there are rows.
        for count in [1, 2, rows, rows + 3] {
            let names = parts(&folder, line, count);
            assert_eq!(folder.done(&format!("merge {names}")), text, "{line} in {count}");
            folder
                .done(&format!("merge {names} --out merged.json --out merged.csv --out merged.svg --force"));
            for ending in ["json", "csv", "svg"] {
                let [whole, merged] =
                    ["whole", "merged"].map(|name| folder.read(&format!("{name}.{ending}")));
                assert!(whole == merged, "{line} in {count}: {ending}");
            }
        }
        // Their order does not matter.
        assert_eq!(folder.done("merge part-2-of-2.json part-1-of-2.json"), text);
    }
}

#[test]
fn foreign_parts_are_refused_by_name() {
    let folder = Folder::new();
    let line = "diagram -G 0.3:0.6:7 --transient 50 --recorded 5";
    parts(&folder, line, 3);
    // Of another restitution, of another command, and no part at all.
    folder.done("diagram -G 0.3:0.6:7 --transient 50 --recorded 5 -r 0.4 --chunk 2/3 --out other.json");
    folder.done("verdicts -G 0.3:0.6:7 --impacts 100 --chunk 2/3 --out verdicts.json");
    folder.done(&format!("{line} --out whole.json"));
    let (one, two, three) = ("merge part-1-of-3.json", "part-2-of-3.json", "part-3-of-3.json");
    let foreign = "is the journal of another computation: its provenance.parameters";
    let lines: [(&str, &str); _] = [
        (&format!("{one} {three}"), "2 of 7 rows are missing, first 3 to 4"),
        (one, "5 of 7 rows are missing, first 3 to 7"),
        (&format!("merge {two}"), "5 of 7 rows are missing, first 1 to 2"),
        (
            &format!("{one} other.json {three}"),
            &format!("\"other.json\" {foreign}.job.restitution is 0.4, but 0.5 is requested"),
        ),
        (
            &format!("{one} verdicts.json {three}"),
            &format!("\"verdicts.json\" {foreign}.command is \"verdicts\", but \"diagram\" is requested"),
        ),
        ("merge whole.json", &no_part("whole.json")),
        (&format!("{one} whole.json"), &no_part("whole.json")),
    ];
    folder.all_refused(2, &lines);
}

/// However the rows are divided, a part is a journal of the same computation.
#[test]
fn parts_of_any_division_and_journals_are_put_together() {
    let folder = Folder::new();
    let line = "verdicts -G 0:2:6 -r 0:0.9:5 --impacts 200";
    let whole = folder.done(line);
    parts(&folder, line, 3);
    parts(&folder, line, 2);
    folder.done(&format!("{line} --chunk 1/2 --journal rows --out part.json"));
    for names in
        ["rows part-2-of-2.json", "part-1-of-2.json part-2-of-3.json part-3-of-3.json part-3-of-3.json"]
    {
        assert_eq!(folder.done(&format!("merge {names}")), whole, "{names}");
    }
    assert!(folder.read("part.json") == folder.read("part-1-of-2.json"));
}

#[test]
fn a_part_that_is_damaged_is_refused() {
    let folder = Folder::new();
    parts(&folder, "verdicts -G 0.3:0.6:4 --impacts 100", 2);
    let whole = folder.text("part-1-of-2.json");
    let digit = whole.rfind("0.").unwrap() + 2;
    let mut changed = whole.clone();
    changed.replace_range(digit..=digit, if &whole[digit..=digit] == "1" { "2" } else { "1" });
    for (text, told) in [
        (changed, "line 3"),
        (whole.replace("\"start\":\"rise\"", "\"start\":\"rest\""), "line 1"),
        (whole.replace("\"index\":1", "\"index\":0"), "line 3"),
        (
            whole[..whole.len() / 8].to_owned(),
            "it is not a part of a computation written by --chunk of this version",
        ),
        (whole[..whole.len() - 9].to_owned(), "1 of 4 rows are missing, first 2 to 2"),
        ("{}".to_owned(), "its format is \"\""),
        ("[]".to_owned(), "its format is \"\""),
    ] {
        assert_ne!(text, whole);
        folder.write("part.json", &text);
        let refusal = folder.refused("merge part.json part-2-of-2.json", 2);
        assert!(refusal.contains(told), "{told}: {refusal}");
    }
}

/// A part goes on from its journal, and is that of no other computation.
#[test]
fn a_part_goes_on_from_its_journal() {
    let folder = Folder::new();
    let line = "verdicts -G 0:2:6 -r 0:0.9:5 --impacts 200";
    folder.done(&format!("{line} --chunk 2/2 --out plain.json"));
    for name in ["first.json", "again.json"] {
        folder.done(&format!("{line} --chunk 2/2 --journal rows --out {name}"));
        assert!(folder.read(name) == folder.read("plain.json"), "{name}");
    }
    // The rows of another part go into the same journal, and are not lost.
    folder.done(&format!("{line} --chunk 1/2 --journal rows --out one.json"));
    folder.done(&format!("{line} --journal rows --out whole.json"));
    folder.done(&format!("{line} --out plain.json --force"));
    assert!(folder.read("whole.json") == folder.read("plain.json"));
    let text = folder.refused("verdicts -G 0:2:6 -r 0:0.9:5 --impacts 201 --journal rows", 2);
    assert!(text.contains("journal of another computation"), "{text}");
    // Half a line, as a power cut may leave it, is cut off; a changed line is seen.
    let whole = folder.read("rows");
    std::fs::write(folder.join("rows"), &whole[..whole.len() - 7]).unwrap();
    folder.done(&format!("{line} --journal rows --out torn.json"));
    assert!(folder.read("torn.json") == folder.read("plain.json"));
    let mut changed = whole;
    let place = changed.iter().rposition(|byte| *byte == b'1').unwrap();
    changed[place] = b'2';
    std::fs::write(folder.join("rows"), changed).unwrap();
    folder.refused(&format!("{line} --journal rows --out changed.json"), 2);
}
