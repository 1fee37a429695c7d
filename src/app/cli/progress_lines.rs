//! Progress where there is no terminal: a line every ten seconds, so that a short command says nothing.

use std::time::Duration;

/// Time without a line after which there is one.
const EVERY: Duration = Duration::from_secs(10);

/// What has been said of the stage, by a clock that is given with each call.
#[derive(Debug, Default)]
pub(super) struct ProgressLines {
    name: String,
    begun: Duration,
    said: Duration,
    done: Option<String>,
}

impl ProgressLines {
    /// A stage begins; a line if it is time for one.
    pub(super) fn begin(&mut self, name: &str, now: Duration) -> Option<String> {
        if self.name != name {
            *self = Self { name: name.to_owned(), begun: now, said: self.said, done: None };
        }
        self.tick(now)
    }

    /// How much of the stage is done, in words; a line if it is time for one.
    pub(super) fn done(&mut self, done: String, now: Duration) -> Option<String> {
        self.done = Some(done);
        self.tick(now)
    }

    /// A line if it is time for one.
    pub(super) fn tick(&mut self, now: Duration) -> Option<String> {
        if self.name.is_empty() || now.saturating_sub(self.said) < EVERY {
            return None;
        }
        self.said = now;
        let done = self.done.as_ref().map_or(String::new(), |done| format!(", {done}"));
        Some(format!("{}: {} s{done}", self.name, now.saturating_sub(self.begun).as_secs()))
    }
}

#[cfg(test)]
mod tests {
    use super::ProgressLines;
    use std::time::Duration;

    #[test]
    fn a_line_is_said_every_ten_seconds() {
        let mut lines = ProgressLines::default();
        let at = |tenths: u64| Duration::from_millis(100 * tenths);
        assert_eq!(lines.tick(at(200)), None);
        let mut lines = ProgressLines::default();
        assert_eq!(lines.begin("read", at(1)), None);
        assert_eq!(lines.begin("condense", at(10)), None);
        assert_eq!(lines.begin("condense", at(15)), None);
        // four ticks a second for half a minute, a share from the middle on
        let mut said = Vec::new();
        for tick in 1..=120 {
            let now = at(10) + Duration::from_millis(250 * tick);
            if tick == 60 {
                assert_eq!(lines.done("40 %".to_owned(), now), None);
            }
            said.extend(lines.tick(now));
        }
        assert_eq!(said, ["condense: 9 s", "condense: 19 s, 40 %", "condense: 29 s, 40 %"]);
        assert_eq!(lines.begin("write", at(320)), None);
        assert_eq!(lines.tick(at(399)), None);
        assert_eq!(lines.tick(at(401)).as_deref(), Some("write: 8 s"));
    }
}
