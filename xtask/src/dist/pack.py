"""Writes archives and checksums that depend on nothing but the files.

archive FILE.tar.gz NAME FILE... packs files in a folder NAME; sums FOLDER SUMS writes the file SUMS in the folder.
"""

import gzip
import hashlib
import os
import pathlib
import sys
import tarfile


def archive(path, name, *files):
    time = int(os.environ["SOURCE_DATE_EPOCH"])
    with open(path, "wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=time) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as tar:
            for file in map(pathlib.Path, files):
                entry = tarfile.TarInfo(f"{name}/{file.name}")
                entry.size, entry.mtime = file.stat().st_size, time
                entry.mode = 0o755 if os.access(file, os.X_OK) else 0o644
                with open(file, "rb") as content:
                    tar.addfile(entry, content)


def sums(folder, name):
    folder = pathlib.Path(folder)
    paths = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    lines = [f"{hashlib.sha256((folder / path).read_bytes()).hexdigest()}  {path}\n" for path in paths]
    partial = folder / f"{name}.partial"
    partial.write_text("".join(lines), encoding="utf-8", newline="\n")
    partial.replace(folder / name)


{"archive": archive, "sums": sums}[sys.argv[1]](*sys.argv[2:])
