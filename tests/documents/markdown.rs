//! What tests of the documents have in common: where they are, and what stands in a page.

use std::env;
use std::fs;
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

impl Block {
    /// The value of a word `NAME=VALUE` behind the fence; GitHub and the book show none of them.
    pub fn word(&self, name: &str) -> Option<&str> {
        let mut words = self.info.split(' ').filter_map(|word| word.split_once('='));
        words.find(|(key, _)| *key == name).map(|(_, value)| value)
    }
}

/// Whether a page is to be brought up to date instead of being judged.
pub fn renews() -> bool {
    env::var_os("PLUMMER_WRITE").is_some()
}

/// Puts other lines into blocks of a page: the line of each one's fence, from 1, and its new lines.
pub fn replace_blocks(page: &Path, new: &[(usize, Vec<String>)]) {
    if new.is_empty() {
        return;
    }
    let text = fs::read_to_string(page).unwrap();
    let mut lines: Vec<&str> = text.lines().collect();
    for (fence, new) in new.iter().rev() {
        let end = *fence + lines[*fence..].iter().position(|line| line.trim_start().starts_with("```")).unwrap();
        lines.splice(*fence..end, new.iter().map(String::as_str));
    }
    fs::write(page, format!("{}\n", lines.join("\n"))).unwrap();
}

#[test]
fn a_block_is_replaced() {
    let page = tempfile::NamedTempFile::new().unwrap();
    fs::write(&page, "a\n```sh\nb\n```\nc\n```text of=d\n```\n").unwrap();
    let new = |lines: &[&str]| lines.iter().map(|&line| line.to_owned()).collect();
    replace_blocks(page.path(), &[(2, new(&["x", "y"])), (6, new(&["z"]))]);
    let text = fs::read_to_string(&page).unwrap();
    assert_eq!(text, "a\n```sh\nx\ny\n```\nc\n```text of=d\nz\n```\n");
    assert_eq!(split(&text).0[1].word("of"), Some("d"));
    assert_eq!(split(&text).0[0].word("of"), None);
}

#[test]
fn fences_part_blocks_from_prose() {
    let (blocks, prose) = split("a\n```sh exit=1\nb\n```\nc\n```text\nd\ne\n```\n");
    assert_eq!(prose, [(1, "a"), (5, "c")]);
    let found: Vec<_> = blocks.iter().map(|block| block.info.as_str()).collect();
    assert_eq!(found, ["sh exit=1", "text"]);
    assert_eq!((blocks[1].lines.as_slice(), blocks[1].line), (&["d".to_owned(), "e".to_owned()][..], 6));
}
