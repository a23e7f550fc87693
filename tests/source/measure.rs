//! Measures of the source: sizes, tunable numbers, fields, parameters and duplicates, read with `syn`.

pub mod imports;
pub mod packages;
pub mod tokens;
pub mod words;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// Most fields of a measured type.
pub const FIELDS: usize = 12;
/// Most parameters of a function, without `self`; a tuple counts as its parts.
pub const PARAMETERS: usize = 7;

/// Modules that plan and follow motions, with their present names and with those before they had modules of their own.
const LOCOMOTION: &[&str] = &[
    "sim/plan",
    "sim/track",
    "sim/get_up",
    "sim/reference/run_detection",
    "sim/reference/run_to_walk",
    "sim/motion/leg_ik",
    "sim/math/banded",
    "sim/math/curve",
    "sim/math/polygon",
    "sim/math/rotation_vector",
    "sim/figure/motion/get_up",
    "sim/figure/motion/activity",
    "sim/figure/motion/exit",
    "sim/figure/get_up",
    "sim/figure/activity",
    "sim/figure/background",
    "sim/figure/tick/motion_switch",
    "sim/figure/tick/playback",
    "sim/gait",
    "sim/motion",
    "sim/figure/rising",
    "sim/figure/planning",
    "sim/figure/step/leaving",
    "sim/figure/step/transitions",
];
/// Parts of `sim/motion` that read, keep or sample motions, without planning them.
const READING: &[&str] = &[
    "sim/motion/bvh",
    "sim/motion/read",
    "sim/motion/recording",
    "sim/motion/skeleton",
    "sim/motion/bvh_write",
    "sim/motion/skeleton_map",
    "sim/motion/retarget",
    "sim/motion/filter",
    "sim/motion/clip",
    "sim/motion/builtin",
    "sim/motion/target",
];
/// Parts whose functions take no tuples, by present and earlier names.
const WITHOUT_TUPLES: &[&str] = &["sim/plan", "sim/figure", "sim/reference", "sim/retarget"];
/// Parts whose types are held to [`FIELDS`], besides those of locomotion.
const HOUSE: &[&str] = &[
    "sim/figure",
    "sim/stepper",
    "sim/paper/params",
    "sim/reference",
];

/// A function or type of the source.
#[derive(Clone, Debug)]
pub struct Item {
    /// Path from the root of the repository, and line.
    pub place: String,
    /// Its name.
    pub name: String,
    /// Fields of a type, parameters of a function, numbers of a constant.
    pub count: usize,
}

/// The measures of one file.
#[derive(Clone, Debug, Default)]
pub struct Source {
    /// Path below `src`, without `.rs` and `/mod`.
    pub module: String,
    /// Lines of code: not blank, not a comment, not of tests.
    pub lines: usize,
    /// Numeric constants.
    pub constants: Vec<Item>,
    /// Numbers in code that are neither constants nor 0, 1, 2 or one half.
    pub literals: usize,
    /// Structs.
    pub types: Vec<Item>,
    /// Functions.
    pub functions: Vec<Item>,
    /// Functions with a tuple among their parameters.
    pub tuples: Vec<Item>,
}

impl Source {
    fn is_in(&self, parts: &[&str]) -> bool {
        parts.iter().any(|part| {
            let rest = self.module.strip_prefix(part);
            rest.is_some_and(|r| r.is_empty() || r.starts_with('/'))
        })
    }

    /// Whether it plans or follows motions.
    pub fn is_locomotion(&self) -> bool {
        self.is_in(LOCOMOTION) && !self.is_in(READING) && self.module != "sim/motion"
    }

    /// Whether its types are held to [`FIELDS`].
    pub fn is_of_the_house(&self) -> bool {
        self.is_locomotion() || self.is_in(HOUSE)
    }

    /// Whether its functions should take no tuples.
    pub fn is_without_tuples(&self) -> bool {
        self.is_in(WITHOUT_TUPLES)
    }

    /// Whether it declares tunable numbers with unit, range and source.
    pub fn has_params(&self) -> bool {
        self.module.ends_with("/params")
    }
}

struct Reader {
    file: String,
    tests: Vec<(usize, usize)>,
    out: Source,
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| {
        a.path().is_ident("test")
            || (a.path().is_ident("cfg") && a.parse_args::<syn::Ident>().is_ok_and(|i| i == "test"))
    })
}

/// Numbers in a numeric type: one, or those of a tuple or an array; 0 for other types.
fn numbers_of(kind: &syn::Type, value: &syn::Expr) -> usize {
    const NUMERIC: &[&str] = &[
        "f64", "f32", "usize", "u64", "u32", "u8", "i64", "i32", "isize",
    ];
    match (kind, value) {
        (syn::Type::Path(p), _) => usize::from(NUMERIC.iter().any(|n| p.path.is_ident(n))),
        (syn::Type::Tuple(t), syn::Expr::Tuple(v)) => t
            .elems
            .iter()
            .zip(&v.elems)
            .map(|(t, v)| numbers_of(t, v))
            .sum(),
        (syn::Type::Array(t), syn::Expr::Array(v)) => {
            v.elems.iter().map(|v| numbers_of(&t.elem, v)).sum()
        }
        (syn::Type::Array(t), syn::Expr::Repeat(v)) => numbers_of(&t.elem, &v.expr),
        (syn::Type::Reference(t), syn::Expr::Reference(v)) => match (&*t.elem, &*v.expr) {
            (syn::Type::Slice(t), syn::Expr::Array(v)) => {
                v.elems.iter().map(|v| numbers_of(&t.elem, v)).sum()
            }
            (t, v) => numbers_of(t, v),
        },
        _ => 0,
    }
}

/// Parameters of a function without `self`; a tuple counts as its parts.
fn parameters(signature: &syn::Signature) -> usize {
    fn parts(kind: &syn::Type) -> usize {
        match kind {
            syn::Type::Tuple(t) => t.elems.iter().map(parts).sum(),
            syn::Type::Reference(t) => parts(&t.elem),
            _ => 1,
        }
    }
    let typed = signature.inputs.iter().filter_map(|i| match i {
        syn::FnArg::Typed(t) => Some(parts(&t.ty)),
        syn::FnArg::Receiver(_) => None,
    });
    typed.sum()
}

/// Parameters of a function that are tuples, or are destructured as such.
fn tuples(signature: &syn::Signature) -> usize {
    fn is_tuple(kind: &syn::Type) -> bool {
        match kind {
            syn::Type::Tuple(t) => t.elems.len() > 1,
            syn::Type::Reference(t) => is_tuple(&t.elem),
            _ => false,
        }
    }
    let tuple = |i: &&syn::FnArg| match i {
        syn::FnArg::Typed(t) => is_tuple(&t.ty) || matches!(*t.pat, syn::Pat::Tuple(_)),
        syn::FnArg::Receiver(_) => false,
    };
    signature.inputs.iter().filter(tuple).count()
}

impl Reader {
    fn item(&self, name: &syn::Ident, count: usize) -> Item {
        Item {
            place: format!("{}:{}", self.file, name.span().start().line),
            name: name.to_string(),
            count,
        }
    }

    fn function(&mut self, signature: &syn::Signature) {
        let item = self.item(&signature.ident, parameters(signature));
        self.out.functions.push(item);
        let tuples = tuples(signature);
        if tuples > 0 {
            let item = self.item(&signature.ident, tuples);
            self.out.tuples.push(item);
        }
    }

    fn skip(&mut self, item: &impl Spanned) {
        let span = item.span();
        self.tests.push((span.start().line, span.end().line));
    }
}

impl<'a> Visit<'a> for Reader {
    fn visit_item_mod(&mut self, item: &'a syn::ItemMod) {
        if is_test(&item.attrs) {
            self.skip(item);
        } else {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_fn(&mut self, item: &'a syn::ItemFn) {
        if is_test(&item.attrs) {
            self.skip(item);
        } else {
            self.function(&item.sig);
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'a syn::ImplItemFn) {
        if is_test(&item.attrs) {
            self.skip(item);
        } else {
            self.function(&item.sig);
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_trait_item_fn(&mut self, item: &'a syn::TraitItemFn) {
        self.function(&item.sig);
        visit::visit_trait_item_fn(self, item);
    }

    fn visit_item_struct(&mut self, item: &'a syn::ItemStruct) {
        if is_test(&item.attrs) {
            self.skip(item);
        } else {
            let item = self.item(&item.ident, item.fields.len());
            self.out.types.push(item);
        }
    }

    fn visit_item_const(&mut self, item: &'a syn::ItemConst) {
        let count = numbers_of(&item.ty, &item.expr);
        if count > 0 && !is_test(&item.attrs) {
            let item = self.item(&item.ident, count);
            self.out.constants.push(item);
        }
    }

    fn visit_item_macro(&mut self, item: &'a syn::ItemMacro) {
        let name = item.mac.path.segments.last();
        if name.is_none_or(|name| name.ident != "params") {
            return;
        }
        // NAME: type = value, "unit", min..=max, "source";
        let mut last = None;
        let mut begins = true;
        for token in item.mac.tokens.clone() {
            match token {
                proc_macro2::TokenTree::Ident(name) if begins => last = Some(name),
                proc_macro2::TokenTree::Punct(p) if p.as_char() == ':' && begins => {
                    if let Some(name) = last.take() {
                        let item = self.item(&name, 1);
                        self.out.constants.push(item);
                    }
                    begins = false;
                }
                proc_macro2::TokenTree::Punct(p) if p.as_char() == ';' => begins = true,
                _ => {}
            }
        }
    }

    fn visit_lit(&mut self, literal: &'a syn::Lit) {
        let usual = |x: f64| [0.0, 0.5, 1.0, 2.0].contains(&x);
        let unusual = match literal {
            syn::Lit::Float(x) => x.base10_parse::<f64>().is_ok_and(|x| !usual(x)),
            syn::Lit::Int(x) => x.base10_parse::<u32>().is_ok_and(|x| !usual(f64::from(x))),
            _ => false,
        };
        self.out.literals += usize::from(unusual);
    }
}

fn read(root: &Path, path: &Path) -> Source {
    let text = fs::read_to_string(path).expect("the file was listed");
    let parsed = syn::parse_file(&text).expect("the source compiles");
    let relative = path.strip_prefix(root).expect("below the root");
    let module = relative
        .strip_prefix("src")
        .unwrap_or(relative)
        .with_extension("");
    let module = module.to_string_lossy().into_owned();
    let mut reader = Reader {
        file: relative.to_string_lossy().into_owned(),
        tests: Vec::new(),
        out: Source {
            module: module.strip_suffix("/mod").unwrap_or(&module).to_owned(),
            ..Source::default()
        },
    };
    reader.visit_file(&parsed);
    let tests = reader.tests;
    let is_code = |(i, line): &(usize, &str)| {
        let line = line.trim();
        let tested = tests.iter().any(|(a, b)| (*a..=*b).contains(&(i + 1)));
        !line.is_empty() && !line.starts_with("//") && !tested
    };
    reader.out.lines = text.lines().enumerate().filter(is_code).count();
    reader.out
}

/// Files below `folder` with this ending, sorted; without generated ones.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            if path.is_dir() {
                if name != "gen" {
                    folders.push(path);
                }
            } else if name.ends_with(ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Every module of the source below `root`, without tests and generated code.
pub fn sources(root: &Path) -> Vec<Source> {
    let is_test = |p: &PathBuf| {
        p.file_name()
            .is_some_and(|n| n == "tests.rs" || n == "testing.rs")
    };
    let all = files(&root.join("src"), ".rs");
    all.iter()
        .filter(|p| !is_test(p))
        .map(|p| read(root, p))
        .collect()
}

/// Names of types that are defined more than once, with their counts, the most frequent first. Types of a trait and
/// types within functions do not count.
pub fn reused_names(root: &Path) -> Vec<(String, usize)> {
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    for file in files(&root.join("src"), ".rs") {
        let text = fs::read_to_string(file).expect("the file was listed");
        for line in text.lines() {
            // Only at the beginning of a line: not within a trait or a function.
            let line = match line.strip_prefix("pub") {
                Some(rest) if rest.starts_with('(') => rest.split_once(") ").map_or("", |(_, r)| r),
                Some(rest) => rest.strip_prefix(' ').unwrap_or_default(),
                None => line,
            };
            let mut words = line.split(' ');
            if let Some("struct" | "enum" | "trait" | "type") = words.next()
                && let Some(name) = words.next()
            {
                let end = name.find(|c: char| !c.is_alphanumeric() && c != '_');
                *count
                    .entry(name[..end.unwrap_or(name.len())].to_owned())
                    .or_default() += 1;
            }
        }
    }
    let mut out: Vec<(String, usize)> = count.into_iter().filter(|(_, n)| *n > 1).collect();
    out.sort_by_key(|(_, n)| std::cmp::Reverse(*n));
    out
}

/// Modules directly below that of the figure, without its tests.
pub fn submodules_of_figure(root: &Path) -> Vec<String> {
    let text = fs::read_to_string(root.join("src/sim/figure/mod.rs")).unwrap_or_default();
    let tokens = tokens::without_tests(&tokens::tokens(&text));
    let modules = (0..tokens.len()).filter(|i| {
        tokens::word(tokens.get(*i)) == Some("mod") && tokens::sign(tokens.get(i + 2), ';')
    });
    let names = modules.filter_map(|i| tokens::word(tokens.get(i + 1)).map(str::to_owned));
    names.collect()
}

/// Number of decision records, without their index.
pub fn decisions(root: &Path) -> usize {
    let records = files(&root.join("docs/adr"), ".md");
    records
        .iter()
        .filter(|p| p.file_name().is_some_and(|n| n != "README.md"))
        .count()
}

/// Names and numbers of the measures that `tests/source/house.rs` holds to limits.
pub fn measures(root: &Path) -> Vec<(&'static str, usize)> {
    let all = sources(root);
    let circles = imports::graph(root).circles();
    let tuples = |of: &dyn Fn(&&Source) -> bool| -> usize {
        all.iter().filter(of).map(|s| s.tuples.len()).sum()
    };
    let locomotion = || all.iter().filter(|s| s.is_locomotion());
    let numbers = |s: &Source| -> usize { s.constants.iter().map(|c| c.count).sum() };
    let [written, generated] = words::of_documents(root);
    let mut out = vec![
        ("links of cargo test", packages::links(root)),
        (
            "crates of the physics, by the lock file",
            packages::closure(root, "src/sim").len(),
        ),
        ("circles of files", circles.len()),
        (
            "files in the largest circle",
            circles.first().map_or(0, Vec::len),
        ),
        (
            "modules directly below figure",
            submodules_of_figure(root).len(),
        ),
        ("reused names of types", reused_names(root).len()),
        (
            "tuple parameters of plan, figure and reference",
            tuples(&|s| s.is_without_tuples()),
        ),
        ("tuple parameters", tuples(&|_| true)),
        (
            "tunable numbers of locomotion",
            locomotion().map(numbers).sum(),
        ),
        (
            "numbers of locomotion outside a params module",
            locomotion().filter(|s| !s.has_params()).map(numbers).sum(),
        ),
        ("words of documents written by hand", written),
        ("words of documents written by commands", generated),
    ];
    out.extend(
        words::PATTERNS
            .into_iter()
            .zip(words::patterns_of_all(root)),
    );
    out
}
