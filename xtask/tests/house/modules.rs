//! Order of imports: a file imports only from modules declared above it. This rules out cycles.

use std::collections::BTreeMap;

use xtask::files::{files_below, text};

#[derive(Debug, Default)]
struct Module {
    file: String,
    /// Child modules in the order of their declaration, without test modules.
    children: Vec<String>,
    /// Re-exported names, each with its path.
    reexports: BTreeMap<String, Vec<String>>,
    /// All other paths in its code, as the code writes them.
    paths: Vec<Vec<String>>,
}

/// All modules of one crate, example or bench by their paths from its root.
type Modules = BTreeMap<Vec<String>, Module>;

/// Code of a file without comments, strings and test modules.
fn code(source: &str) -> String {
    let mut kept = String::new();
    let mut lines = source.lines().peekable();
    while let Some(line) = lines.next() {
        let trimmed = line.trim();
        if trimmed == "#[cfg(test)]" {
            let next = lines.next().unwrap_or_default().trim();
            if next.starts_with("mod ") && next.ends_with('{') {
                break;
            }
            continue;
        }
        let without = match trimmed.starts_with("//") {
            true => "",
            false => line.split(" // ").next().unwrap_or_default(),
        };
        kept.push_str(without);
        kept.push('\n');
    }
    // Strings hold no paths, so every second piece between quotes is dropped.
    kept.split('"').step_by(2).collect::<Vec<_>>().join("\"\"")
}

/// The paths of a `use` tree: `a::{b, c::{d, self}}` is `a::b`, `a::c::d` and `a::c`.
fn use_tree(tree: &str, before: &[String], found: &mut Vec<(String, Vec<String>)>) {
    let mut depth = 0;
    let mut start = 0;
    let mut branches = Vec::new();
    for (at, letter) in tree.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                branches.push(&tree[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    branches.push(&tree[start..]);
    for branch in branches.iter().map(|branch| branch.trim()).filter(|branch| !branch.is_empty()) {
        let (path, inner) = match branch.split_once('{') {
            Some((path, inner)) => (path, inner.strip_suffix('}')),
            None => (branch, None),
        };
        let (path, alias) = match path.split_once(" as ") {
            Some((path, alias)) => (path, Some(alias.trim())),
            None => (path, None),
        };
        let names = path.split("::").map(str::trim).filter(|name| !name.is_empty());
        let mut whole = before.to_vec();
        whole.extend(names.filter(|name| *name != "self").map(str::to_owned));
        match inner {
            Some(inner) => use_tree(inner, &whole, found),
            None => {
                let name = alias.or(whole.last().map(String::as_str)).unwrap_or_default();
                found.push((name.to_owned(), whole));
            }
        }
    }
}

/// Reads the module `path` from `file` and its child modules from `folder` into `modules`.
fn read(modules: &mut Modules, path: Vec<String>, file: &str, folder: &str) {
    let source = text(file);
    let mut module = Module { file: file.to_owned(), ..Module::default() };
    let code = code(&source);
    for statement in code.split([';', '}', '{']) {
        let words: Vec<&str> = statement.split_whitespace().collect();
        if let [.., "mod", name] = words[..]
            && code.contains(&format!("mod {name};"))
        {
            module.children.push(name.to_owned());
        }
    }
    let mut rest = code.as_str();
    while let Some(at) = rest.find("use ") {
        let line_start = rest[..at].rfind('\n').map_or(0, |end| end + 1);
        let lead = rest[line_start..at].trim().to_owned();
        rest = &rest[at + 4..];
        if !(lead.is_empty() || lead.starts_with("pub")) {
            continue;
        }
        let end = rest.find(';').unwrap_or(rest.len());
        let mut found = Vec::new();
        let tree = rest[..end].split_whitespace().collect::<Vec<_>>().join(" ");
        use_tree(&tree, &[], &mut found);
        for (name, names) in found {
            if lead.starts_with("pub") {
                module.reexports.insert(name, names);
            } else {
                module.paths.push(names);
            }
        }
    }
    for start in ["crate::", "super::"] {
        for (at, _) in code.match_indices(start) {
            let inside = code[..at].chars().next_back();
            if inside.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
                continue;
            }
            let end = code[at..]
                .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'))
                .map_or(code.len(), |end| at + end);
            let names = code[at..end].split("::").filter(|name| !name.is_empty());
            module.paths.push(names.map(str::to_owned).collect());
        }
    }
    for child in module.children.clone() {
        let inner = format!("{folder}/{child}");
        let flat = format!("{inner}.rs");
        let nested = format!("{inner}/mod.rs");
        let child_file = [flat, nested].into_iter().find(|file| xtask::files::exists(file));
        if let Some(child_file) = child_file {
            let mut child_path = path.clone();
            child_path.push(child);
            read(modules, child_path, &child_file, &inner);
        }
    }
    modules.insert(path, module);
}

/// The module that defines the item with the path `names`, seen from the module `from`. If another
/// crate defines it, this is `None`. `hops` counts the re-exports that we have followed so far.
fn resolve(
    modules: &Modules,
    from: &[String],
    names: &[String],
    hops: usize,
) -> Option<Vec<String>> {
    let mut names = names.iter().peekable();
    let mut at = from.to_vec();
    match names.peek()?.as_str() {
        "crate" => {
            at.clear();
            names.next();
        }
        "super" => {
            while names.next_if(|name| *name == "super").is_some() {
                at.pop();
            }
        }
        first => {
            let module = &modules[&at];
            let known = module.children.iter().any(|child| child == first);
            if !known && !module.reexports.contains_key(first) {
                return None;
            }
        }
    }
    let rest: Vec<String> = names.cloned().collect();
    for (index, name) in rest.iter().enumerate() {
        let module = modules.get(&at)?;
        let mut child = at.clone();
        child.push(name.clone());
        if modules.contains_key(&child) {
            at = child;
        } else if let Some(behind) = module.reexports.get(name).filter(|_| hops < 8) {
            let mut path = behind.clone();
            path.extend_from_slice(&rest[index + 1..]);
            return resolve(modules, &at, &path, hops + 1);
        } else {
            break;
        }
    }
    Some(at)
}

/// Finds imports in the wrong order: from a module declared below, or of an item of a parent module
/// when the code of the parent uses its children.
fn faults(modules: &Modules) -> Vec<String> {
    let mut faults = Vec::new();
    let mut uses_children = BTreeMap::new();
    let mut edges = Vec::new();
    for (path, module) in modules {
        for names in &module.paths {
            let Some(target) = resolve(modules, path, names, 0) else { continue };
            if target != *path {
                if target.starts_with(path) {
                    uses_children.entry(path.clone()).or_insert_with(|| target.clone());
                }
                edges.push((path, target));
            }
        }
    }
    for (path, target) in edges {
        let user = &modules[path].file;
        let used = &modules[&target].file;
        let shared = path.iter().zip(&target).take_while(|(a, b)| a == b).count();
        if target.len() == shared {
            // An item of a parent module: the parent's own code must not use its children.
            if let Some(child) = uses_children.get(&target) {
                let child = &modules[child].file;
                faults.push(format!("{user} uses {used}, which uses {child}"));
            }
        } else if path.len() > shared {
            let order = &modules[&path[..shared]].children;
            let [target, path] = [&target[shared], &path[shared]]
                .map(|name| order.iter().position(|child| child == name));
            if target >= path {
                faults.push(format!("{user} uses {used}, which is declared below it"));
            }
        }
    }
    faults.sort();
    faults.dedup();
    faults
}

/// Root files of all libraries, and of examples and benches that have several files.
fn roots() -> Vec<String> {
    let all = files_below("");
    all.iter()
        .filter(|path: &&String| {
            let file = path.rsplit('/').next().unwrap_or_default();
            let program = path.contains("/examples/") || path.contains("/benches/");
            path.ends_with("src/lib.rs") || (program && file == "main.rs")
        })
        .cloned()
        .collect()
}

#[test]
fn a_file_uses_only_files_that_stand_above_it() {
    let roots = roots();
    assert!(roots.len() > 8, "crates and examples: {roots:?}");
    let mut all = Vec::new();
    for root in roots {
        let folder = root.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        let mut modules = Modules::new();
        read(&mut modules, Vec::new(), &root, &folder);
        all.extend(faults(&modules));
    }
    assert!(all.is_empty(), "{} imports against the order:\n{}", all.len(), all.join("\n"));
}

fn path(path: &str) -> Vec<String> {
    path.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

fn module(file: &str, children: &[&str], uses: &[&str], reexports: &[(&str, &str)]) -> Module {
    Module {
        file: file.to_owned(),
        children: children.iter().map(|child| (*child).to_owned()).collect(),
        paths: uses.iter().map(|used| path(used)).collect(),
        reexports: reexports.iter().map(|(name, to)| ((*name).to_owned(), path(to))).collect(),
    }
}

#[test]
fn imports_that_run_back_up_are_found() {
    let mut modules = Modules::new();
    modules.insert(path(""), module("lib", &["low", "high"], &[], &[]));
    modules.insert(path("low"), module("low/mod", &["a", "b"], &[], &[("B", "b::B")]));
    modules.insert(path("low::a"), module("a", &[], &["super::b::B", "spectra::Grid"], &[]));
    modules.insert(path("low::b"), module("b", &[], &["super::a::A"], &[]));
    modules.insert(path("high"), module("high", &[], &["crate::low::B"], &[]));
    assert_eq!(faults(&modules), ["a uses b, which is declared below it"]);
    // An import through a name that the parent re-exports.
    modules.insert(path("low::a"), module("a", &[], &["super::B"], &[]));
    assert_eq!(faults(&modules), ["a uses b, which is declared below it"]);
    // A child that uses its parent's own item, while the parent uses children.
    modules.insert(path("low::a"), module("a", &[], &["super::LIMIT"], &[]));
    assert!(faults(&modules).is_empty(), "the parent only re-exports");
    modules.insert(path("low"), module("low/mod", &["a", "b"], &["b::B"], &[]));
    assert_eq!(faults(&modules), ["a uses low/mod, which uses b"]);
    modules.insert(path("low::a"), module("a", &[], &["crate::high::H"], &[]));
    assert_eq!(faults(&modules), ["a uses high, which is declared below it"]);
}
