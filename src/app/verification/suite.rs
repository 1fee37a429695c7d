//! The whole suite in its order: from the beam to the signal, then the paper's own numbers.

use super::beams::beams;
use super::condensation::condensation;
use super::housings::housings;
use super::orders::orders;
use super::paper::paper;
use super::section::{SectionResult, VerificationError};
use super::signals::signals;
use super::simulation::simulation;
use crate::numerics::Watch;

/// Carries out every section that takes seconds; with `full` also the orders of convergence.
///
/// # Errors
/// [`VerificationError`] if something built in cannot be computed; a number that is wrong is no error.
pub(crate) fn suite(full: bool, watch: &impl Watch) -> Result<Vec<SectionResult>, VerificationError> {
    type Section = fn() -> Result<SectionResult, VerificationError>;
    let stages: [(&str, Section); 5] = [
        ("beams", beams),
        ("housings", housings),
        ("condensation", condensation),
        ("simulation", simulation),
        ("signals", signals),
    ];
    let mut sections = Vec::new();
    for (stage, section) in stages {
        watch.stage(stage);
        sections.push(section()?);
    }
    sections.push(paper(watch)?);
    if full {
        watch.stage("orders");
        sections.push(orders()?);
    }
    Ok(sections)
}

#[cfg(test)]
mod tests {
    use super::super::section::Check;
    use super::*;

    /// The sections without the paper's numbers, which have tests of their own.
    fn checks() -> Vec<Check> {
        let sections =
            [beams().unwrap(), housings().unwrap(), condensation().unwrap(), simulation().unwrap(), signals().unwrap()];
        sections.into_iter().flat_map(|section| section.checks).collect()
    }

    #[test]
    fn every_check_passes_and_says_what_it_rests_on() {
        let checks = checks();
        for check in &checks {
            println!("{}", check.line());
            assert!(check.ok, "{}", check.line());
            // a limit that nothing could exceed says nothing
            assert!(check.limit < 0.05, "{}", check.line());
            for text in [&check.name, &check.section, &check.source, &check.assumptions, &check.limit_reason] {
                assert!(!text.is_empty(), "{check:?}");
            }
        }
        assert!(checks.len() >= 40, "{}", checks.len());
        let mut names: Vec<&str> = checks.iter().map(|check| check.name.as_str()).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    }
}
