//! Times a workload natively, for `page/dev/speed.mjs`, which times WebAssembly in turn with it: on each line of the
//! standard input a workload and how often or how large (`impacts 200`, `cells 300`); on each line of the standard
//! output the time of one impact or cell in nanoseconds.
#![allow(clippy::print_stdout, reason = "a program shows its result")]

use std::error::Error;
use std::io::BufRead;
use std::time::Instant;

use bouncing_disk_web::Workloads;

fn main() -> Result<(), Box<dyn Error>> {
    let mut workloads = Workloads::new().ok_or("a parameter is refused")?;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let (name, size) = line.split_once(' ').ok_or("a name and a size")?;
        let begun = Instant::now();
        let count = match name {
            "impacts" => workloads.impacts(size.parse()?)?,
            "cells" => workloads.cells(size.parse()?)?,
            _ => return Err(format!("no workload is called {name}").into()),
        };
        println!("{}", begun.elapsed().as_secs_f64() / count * 1e9);
    }
    Ok(())
}
