//! Progress on a terminal, with the time left; and how long each stage took.

use std::io::{IsTerminal, Write, stderr};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::progress_lines::ProgressLines;
use crate::app::shell_word::printable;
use crate::files::FileDigest;

/// Steps of the bar: finer than any terminal shows.
const STEPS: u64 = 10_000;
const WITHOUT_END: &str = "{spinner} {msg} {elapsed}";
const WITH_END: &str = "{spinner} {msg} {bar:30} {percent} %, {elapsed}, {eta} left";
const COUNTED: &str = "{spinner} {msg} {bar:30} {pos} of {len} files, {eta} left";

/// Time between two movements of what is shown: four a second, also where a foreign library computes and tells nothing.
const TICK: Duration = Duration::from_millis(250);

/// The progress of a command through its stages. It can be shared between threads.
#[derive(Debug)]
pub struct Progress {
    shown: Arc<Shown>,
    stages: Mutex<Vec<(String, Instant)>>,
    files: Mutex<Vec<FileDigest>>,
    ticker: Option<JoinHandle<()>>,
    cache: Option<PathBuf>,
    reused: Mutex<Vec<String>>,
}

/// What a reader sees, moved by a thread of its own.
#[derive(Debug)]
struct Shown {
    bar: ProgressBar,
    /// Lines for a pipe or a file; `None` on a terminal, and where nothing is shown.
    lines: Option<Mutex<ProgressLines>>,
    begun: Instant,
    ended: AtomicBool,
}

impl Shown {
    fn say(&self, of: impl FnOnce(&mut ProgressLines, Duration) -> Option<String>) {
        let Some(lines) = &self.lines else {
            return;
        };
        let mut lines = lines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(line) = of(&mut lines, self.begun.elapsed()) {
            // nobody to tell it to is no failure
            let _ = writeln!(stderr(), "{}", printable(&line));
        }
    }

    fn tick(&self) {
        self.bar.tick();
        self.say(ProgressLines::tick);
    }
}

impl Progress {
    /// Starts without a stage. Later ones are shown on standard error: as a bar on a terminal, as lines elsewhere; or never.
    #[must_use]
    pub fn new(shown: bool) -> Self {
        match (shown, stderr().is_terminal()) {
            (false, _) => Self::on(ProgressDrawTarget::hidden(), None, false),
            (true, true) => Self::on(ProgressDrawTarget::stderr(), None, true),
            (true, false) => Self::on(ProgressDrawTarget::hidden(), Some(ProgressLines::default()), true),
        }
    }

    fn on(target: ProgressDrawTarget, lines: Option<ProgressLines>, moving: bool) -> Self {
        let shown = Arc::new(Shown {
            bar: ProgressBar::with_draw_target(None, target),
            lines: lines.map(Mutex::new),
            begun: Instant::now(),
            ended: AtomicBool::new(false),
        });
        let ticked = Arc::clone(&shown);
        let tick = move || {
            while !ticked.ended.load(Ordering::Relaxed) {
                ticked.tick();
                thread::park_timeout(TICK);
            }
        };
        // without the thread a stage that tells nothing stands still, and that is all
        let ticker = moving.then(|| thread::Builder::new().name("progress".to_owned()).spawn(tick).ok()).flatten();
        Self {
            shown,
            stages: Mutex::new(Vec::new()),
            files: Mutex::new(Vec::new()),
            ticker,
            cache: None,
            reused: Mutex::new(Vec::new()),
        }
    }

    /// Shows a line that stays.
    pub(crate) fn note(&self, line: &str) {
        self.shown.bar.println(printable(line));
        self.shown.say(|_, _| Some(line.to_owned()));
    }

    /// With a folder that keeps what took long.
    pub(super) fn with_cache(mut self, cache: Option<PathBuf>) -> Self {
        self.cache = cache;
        self
    }

    /// What came from that folder, or did not, a sentence each.
    pub(super) fn reused(&self) -> Vec<String> {
        self.reused.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Ends the stage before and begins one of this name, of unknown length until [`Progress::set`].
    pub(crate) fn stage(&self, name: &str) {
        self.stages().push((name.to_owned(), Instant::now()));
        self.shown.bar.unset_length();
        self.shown.bar.set_style(style(WITHOUT_END));
        self.shown.bar.reset();
        self.shown.bar.set_message(name.to_owned());
        self.shown.say(|lines, now| lines.begin(name, now));
    }

    /// Shows how much of the stage is done: 0 to 1; values beyond are taken as the nearest of these, NaN as 0. The first value is
    /// where the stage begins: the time left is estimated from there on.
    pub(crate) fn set(&self, fraction: f64) {
        // From 0 to STEPS; NaN gives 0.
        let position = (fraction.clamp(0.0, 1.0) * STEPS as f64) as u64;
        self.shown.say(|lines, now| lines.done(format!("{} %", 100 * position / STEPS), now));
        if self.shown.bar.length().is_none() {
            self.shown.bar.set_length(STEPS);
            self.shown.bar.set_style(style(WITH_END));
            self.shown.bar.set_position(position);
            // what was done before the stage began, by a run that goes on, says nothing of the time left: the estimate sees
            // it and forgets it
            self.shown.bar.tick();
            self.shown.bar.reset_eta();
            return;
        }
        self.shown.bar.set_position(position);
    }

    /// Shows how many files of a stage are done.
    pub(crate) fn count(&self, done: usize, of: usize) {
        if self.shown.bar.length().is_none() {
            self.shown.bar.set_style(style(COUNTED));
            self.shown.bar.set_length(of as u64);
        }
        self.shown.bar.set_position(done as u64);
        self.shown.say(|lines, now| lines.done(format!("{done} of {of} files"), now));
    }

    /// The meshes that were read, with each content that they had.
    #[must_use]
    pub(crate) fn files(&self) -> Vec<FileDigest> {
        let files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        files.clone()
    }

    /// Takes the bar off the terminal; nothing moves from then on.
    pub fn finish(&self) {
        self.shown.ended.store(true, Ordering::Relaxed);
        self.shown.bar.finish_and_clear();
    }

    /// Returns each stage with the time that it took, s; the last one lasts until now.
    #[must_use]
    pub(crate) fn times(&self) -> Vec<(String, f64)> {
        let stages = self.stages();
        let ends = stages.iter().skip(1).map(|&(_, start)| start);
        stages
            .iter()
            .zip(ends.chain([Instant::now()]))
            .map(|((name, start), end)| (name.clone(), end.duration_since(*start).as_secs_f64()))
            .collect()
    }

    /// The list stays usable when a thread that held it panicked.
    fn stages(&self) -> MutexGuard<'_, Vec<(String, Instant)>> {
        self.stages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.shown.ended.store(true, Ordering::Relaxed);
        if let Some(ticker) = self.ticker.take() {
            ticker.thread().unpark();
            // it ended, one way or the other
            let _ = ticker.join();
        }
    }
}

/// The templates are constants that a test reads; indicatif's own style stands in if one were wrong.
impl crate::numerics::Watch for Progress {
    fn read(&self, file: &FileDigest) {
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        if !files.contains(file) {
            files.push(file.clone());
        }
    }

    fn cache(&self) -> Option<&Path> {
        self.cache.as_deref()
    }

    fn reuse(&self, sentence: String) {
        self.reused.lock().unwrap_or_else(PoisonError::into_inner).push(sentence);
    }

    fn stage(&self, name: &str) {
        Progress::stage(self, name);
    }

    fn note(&self, sentence: &str) {
        Progress::note(self, sentence);
    }

    fn fraction(&self, done: f64) {
        self.set(done);
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::sync::{Arc, Mutex};
    use std::thread::sleep;
    use std::time::Duration;

    use indicatif::{ProgressDrawTarget, ProgressStyle, TermLike};

    use super::{COUNTED, Progress, STEPS, WITH_END, WITHOUT_END};

    /// A terminal that keeps what is written to it.
    #[derive(Debug, Clone, Default)]
    struct Paper(Arc<Mutex<String>>);

    impl TermLike for Paper {
        fn width(&self) -> u16 {
            100
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> io::Result<()> {
            self.write_str(text)
        }
        fn write_str(&self, text: &str) -> io::Result<()> {
            self.0.lock().unwrap().push_str(text);
            Ok(())
        }
        fn clear_line(&self) -> io::Result<()> {
            Ok(())
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn templates_are_well_formed() {
        for template in [WITH_END, WITHOUT_END, COUNTED] {
            assert!(ProgressStyle::with_template(template).is_ok());
        }
    }

    #[test]
    fn a_terminal_shows_stage_share_and_time_left() {
        let paper = Paper::default();
        let target = ProgressDrawTarget::term_like(Box::new(paper.clone()));
        let progress = Progress::on(target, None, false);
        progress.stage("factor");
        sleep(Duration::from_millis(100));
        assert!(paper.0.lock().unwrap().contains("factor"));
        assert!(!paper.0.lock().unwrap().contains("left"));
        progress.set(0.25);
        sleep(Duration::from_millis(100));
        progress.set(0.5);
        let shown = paper.0.lock().unwrap().clone();
        assert!(shown.contains("50 %"), "{shown}");
        // The estimate itself is indicatif's: whole seconds.
        let before = shown.split("s left").next().unwrap_or_default();
        assert!(before.len() < shown.len(), "{shown}");
        assert!(before.ends_with(|last: char| last.is_ascii_digit()), "{shown}");
        progress.finish();
    }

    #[test]
    fn a_stage_that_tells_nothing_moves_by_itself_until_the_end() {
        let paper = Paper::default();
        let length = || paper.0.lock().unwrap().len();
        let progress = Progress::on(ProgressDrawTarget::term_like(Box::new(paper.clone())), None, true);
        progress.stage("factor");
        let mut before = length();
        for _ in 0..3 {
            // a few ticks of a quarter of a second, or ten seconds of a machine that stands still
            let moved = (0..100).any(|_| {
                sleep(Duration::from_millis(100));
                length() > before
            });
            assert!(moved, "{}", paper.0.lock().unwrap());
            before = length();
        }
        progress.note("a point");
        assert!(paper.0.lock().unwrap().contains("a point"));
        let shown = std::sync::Arc::clone(&progress.shown);
        drop(progress);
        assert!(shown.ended.load(std::sync::atomic::Ordering::Relaxed));
    }

    #[test]
    fn what_was_done_before_is_not_taken_for_speed() {
        let progress = Progress::new(false);
        progress.stage("step");
        progress.set(0.9);
        sleep(Duration::from_millis(100));
        progress.set(0.91);
        progress.shown.bar.tick();
        // a hundredth took a tenth of a second: nine more take 0.9 s, or longer on a busy machine; 0.9 in no time at all would
        // leave a hundredth of a second
        let left = progress.shown.bar.eta();
        assert!(left > Duration::from_millis(300), "{left:?}");
    }

    #[test]
    fn files_are_counted() {
        let paper = Paper::default();
        let progress = Progress::on(ProgressDrawTarget::term_like(Box::new(paper.clone())), None, false);
        progress.stage("analyse");
        progress.count(0, 79);
        sleep(Duration::from_millis(100));
        progress.count(12, 79);
        progress.shown.bar.tick();
        let shown = paper.0.lock().unwrap().clone();
        assert!(shown.contains("12 of 79 files"), "{shown}");
        progress.stage("write");
        assert_eq!((progress.shown.bar.position(), progress.shown.bar.length()), (0, None));
    }

    #[test]
    fn fractions_beyond_the_ends_are_held() {
        let progress = Progress::new(false);
        progress.stage("step");
        for (fraction, position) in [(0.5, STEPS / 2), (2.0, STEPS), (-1.0, 0), (f64::NAN, 0), (1.0, STEPS)] {
            progress.set(fraction);
            assert_eq!(progress.shown.bar.position(), position);
        }
        progress.stage("write");
        assert_eq!((progress.shown.bar.position(), progress.shown.bar.length()), (0, None));
    }

    #[test]
    fn stages_are_timed_in_order() {
        let progress = Progress::new(false);
        assert!(progress.times().is_empty());
        progress.stage("read");
        sleep(Duration::from_millis(20));
        progress.stage("assemble");
        let times = progress.times();
        assert_eq!((times[0].0.as_str(), times[1].0.as_str()), ("read", "assemble"));
        assert!(times[0].1 >= 0.02);
        assert!(times[1].1 >= 0.0);
    }
}
