//! What tests of the documents have in common: where they are, and what stands in a page.

use std::path::Path;

/// The repository's folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A fenced block of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// What stands behind the fence: `sh exit=1`.
    pub info: String,
    /// Its lines.
    pub lines: Vec<String>,
    /// Line of the opening fence in the page, from 1.
    pub line: usize,
}

/// A page's fenced blocks, and its lines outside of them with their numbers from 1.
pub fn split(text: &str) -> (Vec<Block>, Vec<(usize, &str)>) {
    let (mut blocks, mut prose): (Vec<Block>, _) = (Vec::new(), Vec::new());
    let mut open = false;
    for (index, line) in text.lines().enumerate() {
        match (line.trim_start().strip_prefix("```"), open) {
            (Some(info), false) => {
                open = true;
                blocks.push(Block { info: info.trim().to_owned(), lines: Vec::new(), line: index + 1 });
            }
            (Some(_), true) => open = false,
            (None, true) => blocks.last_mut().unwrap().lines.push(line.to_owned()),
            (None, false) => prose.push((index + 1, line)),
        }
    }
    assert!(!open, "a fence is not closed");
    (blocks, prose)
}

#[test]
fn fences_part_blocks_from_prose() {
    let (blocks, prose) = split("a\n```sh exit=1\nb\n```\nc\n```text\nd\ne\n```\n");
    assert_eq!(prose, [(1, "a"), (5, "c")]);
    let found: Vec<_> = blocks.iter().map(|block| block.info.as_str()).collect();
    assert_eq!(found, ["sh exit=1", "text"]);
    assert_eq!((blocks[1].lines.as_slice(), blocks[1].line), (&["d".to_owned(), "e".to_owned()][..], 6));
}
