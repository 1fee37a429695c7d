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

/// The program with these arguments in a folder, to its end. What it prints, and a page that it says it wrote, read as a document.
pub fn plummer(folder: &Path, words: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_plummer")).current_dir(folder).args(words).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    for text in [&said, &String::from_utf8_lossy(&output.stderr)] {
        let found = raw_forms(text);
        assert!(found.is_empty(), "{words:?}: {found:?} in {text}");
    }
    let pages = said.lines().filter_map(|line| line.strip_prefix("wrote ")).filter(|name| name.ends_with(".html"));
    for page in pages {
        let typed = words.iter().map(|word| fs::read_to_string(folder.join(word)).unwrap_or_default());
        let typed: String = typed.chain(words.iter().map(|&word| word.to_owned())).collect();
        let found = unreadable(&fs::read_to_string(folder.join(page)).unwrap(), &typed);
        assert!(found.is_empty(), "{words:?}: {page}: {found:?}");
    }
    output
}

/// Names of programs and of their commands that a page may show.
const NAMES: [&str; 5] = ["CalculiX", "NumPy", "SciPy", "BooleanDifference", "BooleanFragments"];

/// Digits that a page may show: frequencies have seven, which tell the halves of a pair apart.
const MOST_DIGITS: usize = 7;

/// Parts of a page that say the case file and the command line as they were typed.
const ECHOES: [(&str, &str); 2] = [("<dl class=\"document\">", "</dl>"), ("<section id=\"reproduce\">", "</section>")];

/// What a page shows that is no text for a reader: identifiers of the program such as `ExactArc`, numbers with more digits than
/// anybody reads, and [`raw_forms`]. Names that were typed in quotes may be as they are, and all where the page echoes what was typed;
/// digests and pictures in space are no text.
pub fn unreadable(page: &str, typed: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut page = page.to_owned();
    for (begin, end) in ECHOES {
        if let Some(from) = page.find(begin) {
            let to = page[from..].find(end).map_or(page.len(), |length| from + length);
            page.replace_range(from..to, "");
        }
    }
    let names: Vec<&str> = typed.split(['"', '\'']).skip(1).step_by(2).collect();
    let is_name = |word: &&str| names.iter().any(|name| name.contains(word));
    for text in texts(&page) {
        if text.trim().starts_with("SHA-256") {
            continue;
        }
        let text = text.replace('\u{202f}', "");
        let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| is_identifier(word));
        found.extend(words.filter(|word| !NAMES.contains(word) && !is_name(word)).map(str::to_owned));
        let numbers = text.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|word| digits(word) > MOST_DIGITS);
        found.extend(numbers.filter(|number| !is_name(number)).map(str::to_owned));
        found.extend(raw_forms(&text));
    }
    found
}

/// Numbers and units as a program writes them and a reader does not: a zero with a minus, a power of ten that is one, "um" for "µm", a
/// power with a decimal point, an exact value with an error of nothing.
pub fn raw_forms(text: &str) -> Vec<String> {
    let words: Vec<&str> = text.split(|c: char| c.is_whitespace() || "(),;:|=[]".contains(c)).collect();
    let has_digit = |word: &str| word.bytes().any(|b| b.is_ascii_digit());
    let raw = |word: &&&str| {
        let zero = word.strip_prefix(['-', '−']).is_some_and(|number| number.chars().all(|c| c == '0' || c == '.'));
        let one = word.strip_suffix("e0").is_some_and(|number| number.ends_with(|c: char| c.is_ascii_digit()));
        zero && has_digit(word) || one && word.parse::<f64>().is_ok() || word.contains("^1.5")
    };
    let mut found: Vec<String> = words.iter().filter(raw).map(|word| (*word).to_owned()).collect();
    let pairs = words.windows(2).filter(|pair| pair[1] == "um" && has_digit(pair[0]));
    found.extend(pairs.map(|pair| pair.join(" ")));
    found.extend(text.contains("exact, to 0").then(|| "exact, to 0".to_owned()));
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
    assert_eq!(unreadable(page, "name = \"MySensor\""), ["ExactArc", "25599.999839999375"]);
    // what was typed is ignored where it is echoed, not elsewhere
    let page = "<dl class=\"document\"><dd>--set a=25599.99983 ExactArc</dd></dl><p>25599.99983 Hz, ExactArc</p>\
        <section id=\"reproduce\">25599.99983</section>";
    assert_eq!(unreadable(page, "a=25599.99983 ExactArc"), ["ExactArc", "25599.99983"]);
}

#[test]
fn forms_of_programs_are_found() {
    let text = "moved by -0.00 %, −0 N, 1.391433e0 kg, 15 um, 12 GN/m^1.5, exact, to 0 %; 2e-3 m, -0.5 N, 1e10 Hz, 0.0, 2026-11-26, -";
    assert_eq!(raw_forms(text), ["-0.00", "−0", "1.391433e0", "GN/m^1.5", "15 um", "exact, to 0"]);
    assert!(raw_forms("length unit um, in; x-0 node 0xe0").is_empty());
}

/// What it wrote to standard error behind the lines of its progress: from the first error or warning on.
pub fn errors(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    let mut lines =
        text.split_inclusive('\n').skip_while(|line| !line.starts_with("error") && !line.starts_with("warning"));
    let first = lines.next().unwrap_or_default().to_owned();
    lines.fold(first, |all, line| all + line)
}
