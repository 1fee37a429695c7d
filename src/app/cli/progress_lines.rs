//! Progress where there is no terminal: a line when a stage begins, and one every ten seconds of it.

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
    /// A stage begins: its line, unless it is the same as before.
    pub(super) fn begin(&mut self, name: &str, now: Duration) -> Option<String> {
        if self.name == name {
            return None;
        }
        *self = Self { name: name.to_owned(), begun: now, said: now, done: None };
        Some(name.to_owned())
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
    fn stages_are_said_when_they_begin_and_every_ten_seconds() {
        let mut lines = ProgressLines::default();
        let at = |tenths: u64| Duration::from_millis(100 * tenths);
        assert_eq!(lines.tick(at(200)), None);
        assert_eq!(lines.begin("read", at(200)).as_deref(), Some("read"));
        assert_eq!(lines.begin("condense", at(210)).as_deref(), Some("condense"));
        // the same stage again is no news
        assert_eq!(lines.begin("condense", at(215)), None);
        // four ticks a second for half a minute, a share from the middle on
        let mut said = Vec::new();
        for tick in 1..=120 {
            let now = at(210) + Duration::from_millis(250 * tick);
            if tick == 60 {
                assert_eq!(lines.done("40 %".to_owned(), now), None);
            }
            said.extend(lines.tick(now));
        }
        assert_eq!(said, ["condense: 10 s", "condense: 20 s, 40 %", "condense: 30 s, 40 %"]);
        assert_eq!(lines.begin("write", at(520)).as_deref(), Some("write"));
        assert_eq!(lines.tick(at(600)), None);
        assert_eq!(lines.tick(at(630)).as_deref(), Some("write: 11 s"));
    }
}
