//! What a designation says beside the size of a bearing: its maker, its suffixes, and whether it is of another type.

/// Names that are printed before a designation.
const MAKERS: [&str; 17] = [
    "SKF", "FAG", "INA", "NSK", "NTN", "SNR", "GMN", "TIMKEN", "FAFNIR", "KOYO", "JTEKT", "NACHI", "NMB", "ZKL", "ZWZ",
    "RHP", "BARDEN",
];

/// What stands between maker, number and suffixes.
pub(super) const SEPARATORS: [char; 4] = [' ', '-', '/', '_'];

/// Suffixes that leave balls and raceways as they are: seals, shields, clearance, snap rings, cages of steel, brass and polyamide,
/// accuracy, grease. Longer ones first. Others may be another inner design (E, A, B, X) or other balls (HC5).
const SUFFIXES: [&str; 52] = [
    "2RS1", "2RSR", "2RSH", "2RSL", "2NSE", "2HRS", "GJN", "LHT", "ZNR", "2RS", "2RZ", "2ZR", "RSR", "RS1", "RSH",
    "RSL", "NSE", "ZZE", "DDU", "LLU", "LLB", "LLH", "TN9", "TNH", "TVH", "TVP", "W64", "2Z", "ZZ", "ZR", "RS", "RZ",
    "DD", "VV", "LU", "LB", "C2", "C3", "C4", "C5", "CN", "CM", "P6", "P5", "P4", "NR", "ZN", "MA", "MB", "Z", "N",
    "M",
];

/// Letters before the number, and what they are (DIN 623-1, DIN 5425-1).
const BY_LETTERS: [(&[&str], &str); 4] = [
    (&["N", "NU", "NJ", "NUP", "NF", "NN", "NNU", "NCF", "RN", "RNU"], "a cylindrical roller bearing"),
    (&["NA", "RNA", "NK", "NKI", "NKIS", "HK", "BK"], "a needle roller bearing"),
    (&["QJ"], "a four-point contact ball bearing"),
    (&["UC", "YAR", "GYE"], "an insert bearing"),
];

/// First digit and number of digits, and what they are.
const BY_DIGITS: [(char, usize, &str); 9] = [
    ('1', 4, "a self-aligning ball bearing"),
    ('2', 4, "a self-aligning ball bearing"),
    ('2', 5, "a spherical roller bearing"),
    ('3', 4, "a double-row angular contact ball bearing"),
    ('3', 5, "a tapered roller bearing"),
    ('4', 4, "a double-row deep groove ball bearing"),
    ('5', 5, "a thrust ball bearing"),
    ('7', 4, "an angular contact ball bearing"),
    ('8', 5, "a cylindrical roller thrust bearing"),
];

/// A designation in its parts, as typed.
pub(super) struct Designation<'n> {
    /// Empty: none is named.
    pub(super) maker: &'n str,
    letters: &'n str,
    /// Digits, and the suffixes behind them.
    number: &'n str,
}

impl<'n> Designation<'n> {
    pub(super) fn of(name: &'n str) -> Self {
        let name = name.trim();
        let named = |maker: &&str| name.get(..maker.len()).is_some_and(|start| start.eq_ignore_ascii_case(maker));
        let (maker, rest) = name.split_at(MAKERS.into_iter().find(named).map_or(0, str::len));
        let rest = if maker.is_empty() { rest } else { rest.trim_start_matches(SEPARATORS) };
        let (letters, rest) =
            rest.split_at(rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_alphabetic()).len());
        let number = if letters.is_empty() { rest } else { rest.trim_start_matches(SEPARATORS) };
        Self { maker, letters, number }
    }

    fn digits(&self) -> &'n str {
        &self.number[..self.number.len() - self.number.trim_start_matches(|c: char| c.is_ascii_digit()).len()]
    }

    /// A number that is known and the suffixes, whose first digit may follow on the number: `62052RS`.
    pub(super) fn known(&self, is_known: impl Fn(&str) -> bool) -> Option<(&'n str, &'n str)> {
        let digits = self.digits();
        let suffix = &self.number[digits.len()..];
        // a name with a dot is that of a file
        if !self.letters.is_empty() || suffix.contains('.') {
            return None;
        }
        let shorter = digits.strip_suffix('2').filter(|_| suffix.starts_with(['R', 'r', 'Z', 'z']));
        let number = [Some(digits), shorter].into_iter().flatten().find(|number| is_known(number))?;
        let (number, suffixes) = self.number.split_at(number.len());
        counts_for_nothing(suffixes).then_some((number, suffixes))
    }

    pub(super) fn other_type(&self) -> Option<&'static str> {
        let digits = self.digits();
        if !self.letters.is_empty() {
            let is = |names: &[&str]| names.iter().any(|name| name.eq_ignore_ascii_case(self.letters));
            return BY_LETTERS.iter().find(|(names, _)| !digits.is_empty() && is(names)).map(|(_, kind)| *kind);
        }
        let is = |&&(first, count, _): &&(char, usize, &str)| digits.starts_with(first) && digits.len() == count;
        BY_DIGITS.iter().find(is).map(|&(.., kind)| kind)
    }
}

/// Only [`SUFFIXES`], with or without separators between them.
fn counts_for_nothing(suffixes: &str) -> bool {
    let rest = suffixes.trim_start_matches(SEPARATORS);
    let known = |suffix: &&str| rest.get(..suffix.len()).is_some_and(|start| start.eq_ignore_ascii_case(suffix));
    rest.is_empty() || SUFFIXES.into_iter().find(known).is_some_and(|suffix| counts_for_nothing(&rest[suffix.len()..]))
}
