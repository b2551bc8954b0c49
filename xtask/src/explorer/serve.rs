//! A web server of this machine alone, for looking at the page as it is hosted.

use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use anyhow::{Context, Result};

use crate::output::say;

/// Longest request line that is read.
const LONGEST_LINE: u64 = 8192;

/// Serves the files of a folder until the program is interrupted.
pub(super) fn folder(folder: &Path, port: u16) -> Result<()> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))
        .with_context(|| format!("port {port} is taken; --port 0 takes any that is free"))?;
    let address = format!("http://{}/", listener.local_addr()?);
    say!("{address} (Ctrl-C ends it)")?;
    open(&address);
    // A browser that goes away ends its own request alone.
    for connection in listener.incoming().flatten() {
        let folder = folder.to_owned();
        std::thread::spawn(move || answer(connection, &folder));
    }
    Ok(())
}

/// Asks the desktop for a browser; where there is none the address has been said.
fn open(address: &str) {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/C", "start"])
    } else {
        ("xdg-open", &[])
    };
    let mut browser = Command::new(program);
    let quiet = browser.args(arguments).arg(address).stdout(Stdio::null()).stderr(Stdio::null());
    drop(quiet.spawn());
}

fn answer(mut connection: TcpStream, folder: &Path) -> std::io::Result<()> {
    connection.set_read_timeout(Some(Duration::from_secs(10)))?;
    let mut line = String::new();
    std::io::Read::take(BufReader::new(&connection), LONGEST_LINE).read_line(&mut line)?;
    let target = line.strip_prefix("GET ").and_then(|rest| rest.split(' ').next());
    let (status, kind, body) = match target.and_then(|target| file(folder, target)) {
        None => ("400 Bad Request", "text/plain", Vec::new()),
        Some(path) => match std::fs::read(&path) {
            Ok(body) => ("200 OK", kind(&path), body),
            Err(error) if error.kind() == ErrorKind::NotFound => ("404 Not Found", "text/plain", Vec::new()),
            Err(_) => ("500 Internal Server Error", "text/plain", Vec::new()),
        },
    };
    let length = body.len();
    write!(
        connection,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n"
    )?;
    connection.write_all(&body)
}

/// The file of a request, which lies in the folder; `None` for one that does not.
fn file(folder: &Path, target: &str) -> Option<PathBuf> {
    let path = target.split(['?', '#']).next()?.strip_prefix('/')?;
    let path = Path::new(if path.is_empty() { "index.html" } else { path });
    path.components().all(|part| matches!(part, Component::Normal(_))).then(|| folder.join(path))
}

/// What a browser must know of a file.
fn kind(path: &Path) -> &'static str {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    #[test]
    fn only_files_of_the_folder_are_served() {
        let folder = Path::new("/site");
        assert_eq!(file(folder, "/"), Some(PathBuf::from("/site/index.html")));
        assert_eq!(file(folder, "/a/b.js?x#y"), Some(PathBuf::from("/site/a/b.js")));
        for outside in ["/../secret", "/a/../../secret", "//etc/passwd", "etc/passwd", ""] {
            assert_eq!(file(folder, outside), None, "{outside}");
        }
    }

    #[test]
    fn a_browser_gets_a_file_and_is_told_of_one_that_is_missing() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("index.html"), "page").expect("a file");
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
        let address = listener.local_addr().expect("an address");
        for (request, status) in
            [("GET / ", "200 OK"), ("GET /none.js ", "404 Not Found"), ("POST / ", "400 Bad Request")]
        {
            let mut browser = TcpStream::connect(address).expect("a connection");
            browser.write_all(format!("{request}HTTP/1.1\r\n\r\n").as_bytes()).expect("a request");
            answer(listener.accept().expect("a browser").0, folder.path()).expect("an answer");
            let mut text = String::new();
            browser.read_to_string(&mut text).expect("text");
            assert!(text.starts_with(&format!("HTTP/1.1 {status}\r\n")), "{text}");
            assert_eq!(text.ends_with("\r\n\r\npage"), status == "200 OK", "{text}");
        }
    }
}
