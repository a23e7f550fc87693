//! Writes the page of all tunable numbers: `cargo run --example parameters > docs/parameters.md`.
//!
//! `tests/pages.rs` compares the page with this output.

mod page;

fn main() {
    print!("{}", page::page());
}
