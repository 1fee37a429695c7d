//! What tests of the program from outside have in common: folders of their own, and the program run in them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder of a test's own.
pub fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The program with these arguments in a folder, to its end. A page that it says it wrote reads as a document.
pub fn plummer(folder: &Path, words: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_plummer")).current_dir(folder).args(words).output().unwrap();
    if ["run", "modes", "condense", "frf", "analyze"].iter().any(|command| words.contains(command)) {
        let said = String::from_utf8_lossy(&output.stdout);
        let pages = said.lines().filter_map(|line| line.strip_prefix("wrote ")).filter(|name| name.ends_with(".html"));
        for page in pages {
            let typed = words.iter().map(|word| fs::read_to_string(folder.join(word)).unwrap_or_default());
            let typed: String = typed.chain(words.iter().map(|&word| word.to_owned())).collect();
            let found = unreadable(&fs::read_to_string(folder.join(page)).unwrap(), &typed);
            assert!(found.is_empty(), "{words:?}: {page}: {found:?}");
        }
    }
    output
}

/// Names of programs and of their commands that a page may show.
const NAMES: [&str; 3] = ["CalculiX", "BooleanDifference", "BooleanFragments"];

/// Digits that a page may show: frequencies have seven, which tell the halves of a pair apart.
const MOST_DIGITS: usize = 7;

/// What a page shows that is no text for a reader: identifiers of the program such as `ExactArc`, and numbers with more digits than
/// anybody reads. Names that were typed may be as they are; digests and pictures in space are no text.
pub fn unreadable(page: &str, typed: &str) -> Vec<String> {
    let mut found = Vec::new();
    for text in texts(page) {
        if text.trim().starts_with("SHA-256") {
            continue;
        }
        let text = text.replace('\u{202f}', "");
        let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| is_identifier(word));
        found.extend(words.filter(|word| !NAMES.contains(word) && !typed.contains(word)).map(str::to_owned));
        let numbers = text.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|word| digits(word) > MOST_DIGITS);
        found.extend(numbers.filter(|number| !typed.contains(number)).map(str::to_owned));
    }
    found
}

/// The texts between the tags of a page, without scripts and styles.
fn texts(page: &str) -> Vec<&str> {
    let mut texts = Vec::new();
    let mut rest = page;
    while let Some((text, tag)) = rest.split_once('<') {
        texts.push(text);
        let skipped = ["script", "style", "!--"].into_iter().find(|name| tag.starts_with(name));
        let end = match skipped {
            Some("!--") => tag.find("-->").map(|at| at + 3),
            Some(name) => tag.find(&format!("</{name}>")).map(|at| at + name.len() + 3),
            None => tag.find('>').map(|at| at + 1),
        };
        rest = &tag[end.unwrap_or(tag.len())..];
    }
    texts
}

/// Whether a word has a capital letter after a small one, with a capital in front: `ExactArc`.
fn is_identifier(word: &str) -> bool {
    let letters: Vec<char> = word.chars().collect();
    let capital = letters.first().is_some_and(|first| first.is_ascii_uppercase());
    capital && letters.windows(2).skip(1).any(|pair| pair[0].is_ascii_lowercase() && pair[1].is_ascii_uppercase())
}

/// Significant digits of a number as it is written.
fn digits(number: &str) -> usize {
    let digits: String = number.chars().filter(char::is_ascii_digit).collect();
    let digits = digits.trim_start_matches('0');
    if number.contains('.') { digits.len() } else { digits.trim_end_matches('0').len() }
}

#[test]
fn identifiers_and_raw_numbers_on_a_page_are_found() {
    let page = "<p>an ExactArc at 25599.999839999375 Hz</p><script>var x = 123456789.5; SomeName</script>\
        <td>16\u{202f}300.79</td><span>SHA-256 9108123456789</span><b>CalculiX, MySensor, 120000000 N</b>";
    assert_eq!(unreadable(page, "MySensor"), ["ExactArc", "25599.999839999375"]);
}

/// What it wrote to standard error behind the lines of its progress: from the first error or warning on.
pub fn errors(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    let mut lines =
        text.split_inclusive('\n').skip_while(|line| !line.starts_with("error") && !line.starts_with("warning"));
    let first = lines.next().unwrap_or_default().to_owned();
    lines.fold(first, |all, line| all + line)
}
