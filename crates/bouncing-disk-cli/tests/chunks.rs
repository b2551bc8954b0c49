//! Chunks and their merge: the same bytes as without, and a refusal of foreign parts by name.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod common;

use common::Folder;

/// A quick line of each command that can be divided, with its number of rows.
const GRIDS: [(&str, usize); 6] = [
    ("diagram -G 0.3:0.6:7 --transient 50 --recorded 20", 7),
    ("verdicts -G 0.3:0.6:5 --impacts 500 --transient 100", 5),
    ("verdicts -G 0:1:6 -r 0:0.9:4 --impacts 500 --transient 100 --start period-1", 4),
    ("basins -G 0.55 --cells 9 --starts 50 --impacts 300", 9),
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
    // Of another restitution, of another number of parts, of another command, and no part at all.
    folder.done("diagram -G 0.3:0.6:7 --transient 50 --recorded 5 -r 0.4 --chunk 2/3 --out other.json");
    folder.done(&format!("{line} --chunk 2/4 --out four.json"));
    folder.done("verdicts -G 0.3:0.6:7 --impacts 100 --chunk 2/3 --out verdicts.json");
    folder.done(&format!("{line} --out whole.json"));
    let foreign = "is of another computation: its";
    let (one, two, three) = ("merge part-1-of-3.json", "part-2-of-3.json", "part-3-of-3.json");
    folder.all_refused(
        2,
        &[
            (&format!("{one} {three}"), "chunks are missing: 2/3"),
            (one, "chunks are missing: 2/3, 3/3"),
            (&format!("{one} {two} {three} {two}"), "chunk 2 is there twice"),
            (&format!("{one} other.json {three}"), &format!("other.json {foreign} job.restitution is 0.4")),
            (&format!("{one} four.json {three}"), &format!("four.json {foreign} number of chunks is 4")),
            (
                &format!("{one} verdicts.json {three}"),
                &format!("verdicts.json {foreign} command is verdicts, where part-1-of-3.json has diagram"),
            ),
            ("merge whole.json", "is not a file of the format \"bouncing-disk chunk\""),
        ],
    );
}

#[test]
fn a_part_that_is_damaged_is_refused() {
    let folder = Folder::new();
    parts(&folder, "verdicts -G 0.3:0.6:4 --impacts 100", 2);
    let whole = folder.text("part-1-of-2.json");
    let digit = whole.rfind("0.").unwrap() + 2;
    let changed = format!(
        "{}{}{}",
        &whole[..digit],
        if &whole[digit..=digit] == "1" { "2" } else { "1" },
        &whole[digit + 1..]
    );
    for (text, told) in [
        (changed, "it is damaged: its rows_digest"),
        (whole[..whole.len() / 2].to_owned(), "it is no whole chunk"),
        (whole.replace("\"start\":\"rise\"", "\"start\":\"rest\""), "it is damaged: its job_digest"),
        (
            whole.replace("\"index\":1", "\"index\":0").replace("\"index\": 1", "\"index\": 0"),
            "it is damaged: its rows_digest",
        ),
        (whole.replace("\"first_row\": 0", "\"first_row\": 1"), "it is damaged: its rows_digest"),
        // One of very many parts, which nobody lists.
        (whole.replace("\"count\": 2", "\"count\": 2000000000000"), "it is damaged: its rows_digest"),
        ("{}".to_owned(), "its format is \"\""),
        ("[]".to_owned(), "its format is \"\""),
    ] {
        assert_ne!(text, whole);
        folder.write("part.json", &text);
        let refusal = folder.refused("merge part.json part-2-of-2.json", 2);
        assert!(refusal.contains("part.json") && refusal.contains(told), "{told}: {refusal}");
    }
}

/// A part goes on from its journal, which is that of no other part.
#[test]
fn a_part_has_a_journal_of_its_own() {
    let folder = Folder::new();
    let line = "verdicts -G 0:2:6 -r 0:0.9:5 --impacts 200";
    folder.done(&format!("{line} --chunk 2/2 --out plain.json"));
    for name in ["first.json", "again.json"] {
        folder.done(&format!("{line} --chunk 2/2 --journal rows --out {name}"));
        assert!(folder.read(name) == folder.read("plain.json"), "{name}");
    }
    for other in ["--chunk 1/2 --out other.json", "--chunk 3/4 --out other.json", "--out other.csv"] {
        let text = folder.refused(&format!("{line} {other} --journal rows"), 2);
        assert!(text.contains("journal of another computation"), "{other}: {text}");
    }
    // Half a line, as a power cut may leave it, is cut off; a changed line is seen.
    let whole = folder.read("rows");
    std::fs::write(folder.join("rows"), &whole[..whole.len() - 7]).unwrap();
    folder.done(&format!("{line} --chunk 2/2 --journal rows --out torn.json"));
    assert!(folder.read("torn.json") == folder.read("plain.json") && folder.read("rows") == whole);
    let place = whole.iter().rposition(|byte| *byte == b'1').unwrap();
    let mut changed = whole;
    changed[place] = b'2';
    std::fs::write(folder.join("rows"), changed).unwrap();
    folder.refused(&format!("{line} --chunk 2/2 --journal rows --out changed.json"), 2);
}
