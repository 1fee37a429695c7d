//! Circles of a directed graph: its strongly connected parts of two or more members.

use std::collections::{BTreeMap, BTreeSet};

type Graph = BTreeMap<String, BTreeSet<String>>;

/// All that can be reached from a member, the member itself only if a way leads back to it.
fn reached<'a>(graph: &'a Graph, from: &str) -> BTreeSet<&'a str> {
    let mut seen = BTreeSet::new();
    let mut left: Vec<&str> = graph.get(from).into_iter().flatten().map(String::as_str).collect();
    while let Some(next) = left.pop() {
        if seen.insert(next) {
            left.extend(graph.get(next).into_iter().flatten().map(String::as_str));
        }
    }
    seen
}

/// Every circle, as the set of its members.
pub fn circles(graph: &Graph) -> BTreeSet<BTreeSet<String>> {
    let ways: BTreeMap<&str, BTreeSet<&str>> = graph.keys().map(|name| (name.as_str(), reached(graph, name))).collect();
    let back = |from: &str, to: &str| ways.get(from).is_some_and(|way| way.contains(to));
    let circle = |name: &&str| {
        let others = ways[name].iter().filter(|other| back(other, name));
        let members: BTreeSet<String> = others.map(|other| (*other).to_owned()).collect();
        (members.len() > 1).then_some(members)
    };
    ways.keys().filter_map(circle).collect()
}
