//! The section of the suite: solids, rings and steps.

use super::{Family, rings, solids, steps};
use crate::app::verification::section::{SectionResult, VerificationError};
use crate::report::Section;

/// Title of the section.
const TITLE: &str = "Orders of convergence";

/// Carries the section out.
///
/// # Errors
/// [`VerificationError`] if a model cannot be built or computed.
pub(crate) fn orders() -> Result<SectionResult, VerificationError> {
    let families = [solids::solids()?, rings::rings()?, steps::steps()?];
    let checks = families.iter().flat_map(Family::checks).collect();
    let mut report = Section::new(TITLE).paragraph(
        "The order is the slope of the error over the size on logarithmic axes, from one size to the next; the check judges the last.",
    );
    for family in &families {
        report = report.table(family.table()).plot(family.plot());
    }
    let mut section = SectionResult::of_checks(TITLE, checks);
    section.report = vec![report];
    section.orders = Some(families.into_iter().flat_map(|family| family.series).collect());
    Ok(section)
}

#[cfg(test)]
mod tests {
    use super::orders;

    #[test]
    fn every_order_is_that_of_theory() {
        let section = orders().unwrap();
        for check in &section.checks {
            println!("{}", check.line());
            assert!(check.ok, "{}", check.line());
        }
        assert_eq!(section.checks.len(), 4 * 4 + 3 + 5);
        // conforming elements are too stiff, and on boxes the incompatible one is too
        let series = section.orders.unwrap();
        for series in series.iter().filter(|series| series.unit == "m") {
            let above = series.relative_errors.iter().all(|&error| error > 0.0);
            assert!(above, "{series:?}");
        }
    }
}
