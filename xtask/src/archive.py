# Sets the report on standard input as report.pdf in a folder, and prints the folder as a tape archive: sorted, without
# times, owners and fonts of the machine, so that the same report gives the same bytes.
import importlib.metadata
import pathlib
import sys
import tarfile

WANTED, MOST_PAGES = "0.15.2", 12
try:
    found = importlib.metadata.version("typst")
except importlib.metadata.PackageNotFoundError:
    found = "none"
if found != WANTED:
    sys.exit(f"typst {WANTED} is needed, found {found}: {sys.executable} -m pip install typst=={WANTED}")
import typst

folder, name = pathlib.Path(sys.argv[1]), sys.argv[2]
source, options = sys.stdin.buffer.read(), {"root": folder, "ignore_system_fonts": True}
pages = int(typst.query(source, "<pages>", field="value", one=True, **options))
if pages > MOST_PAGES:
    sys.exit(f"the report has {pages} pages; at most {MOST_PAGES} are allowed")
(folder / "report.pdf").write_bytes(typst.compile(source, format="pdf", **options))
with tarfile.open(fileobj=sys.stdout.buffer, mode="w|", format=tarfile.USTAR_FORMAT) as archive:
    files = (path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    for file in sorted(files):
        entry = tarfile.TarInfo(f"{name}/{file}")
        entry.size = (folder / file).stat().st_size
        with (folder / file).open("rb") as content:
            archive.addfile(entry, content)
