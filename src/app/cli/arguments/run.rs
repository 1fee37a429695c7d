//! `plummer run`: its examples, and its pause between checkpoints.

use super::number::number;

pub(super) const RUN_EXAMPLE: &str = "\
Examples: the dented bearing with a deeper dent, in a folder of its own; the same run goes on after Ctrl-C or a power failure
  plummer run examples/tadina2011/outer-dent.toml --set 'bearing.defects[0].depth=2e-5' --out out/deeper
  plummer run examples/tadina2011/outer-dent.toml --set 'bearing.defects[0].depth=2e-5' --out out/deeper --resume

Long runs: memory does not grow with the simulated time. Signals go to DIR/.run.partial, with a checkpoint every 10 s. Ctrl-C
keeps a checkpoint and ends with exit code 1; a second Ctrl-C ends at once. With --resume the run goes on. With the same program,
case, --set and meshes its signals are those of a run without a stop, bit by bit.";

/// A pause between checkpoints: not negative, at most a year.
pub(super) fn pause(text: &str) -> Result<f64, String> {
    number(text, |pause| (0.0..=3.2e7).contains(&pause), "seconds from 0 to 3.2e7")
}
