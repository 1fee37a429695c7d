//! `plummer verify`: the built-in verification suite.

use super::earlier_results::{left_in, result_of};
use super::report::ReportFiles;
use super::results::result_head;
use super::{CliError, Options, Outcome, OutputFolder, Progress, failure, typed};
use crate::app::verification::{Check, SectionResult, VerifyResult, suite};
use crate::report::Report;
use std::path::Path;

/// Folder of the results unless another is named.
const FOLDER: &str = "out/verify";

/// Carries the suite out and writes `report.html`, its tables and figures and, last, `verify.json`; `full` adds the orders of
/// convergence.
///
/// # Errors
/// [`CliError`] when a check cannot be carried out or a file cannot be written.
pub(crate) fn verify(full: bool, options: &Options) -> Result<Outcome, CliError> {
    let folder = OutputFolder::at(options.out.as_deref().unwrap_or(Path::new(FOLDER)));
    folder.claim_unless(&["verify.json"], options.force, |path| {
        let earlier = result_of("verify", path);
        let less = (earlier["full"] == true && !full).then_some(" with --full");
        if earlier.is_null() { Some("") } else { less }
    })?;
    failure::on_interrupt(left_in(&folder.path, "verify", options.force));
    let progress = Progress::new(options.shows_progress());
    let started = std::time::Instant::now();
    let sections = suite(full, &progress).map_err(|error| CliError::failed(error.to_string()));
    let outcome = sections.and_then(|sections| {
        let wall_s = started.elapsed().as_secs_f64();
        conclude(&sections, full, &folder, &progress, wall_s)
    });
    progress.finish();
    outcome
}

/// Writes what the sections hand on, and judges.
fn conclude(
    sections: &[SectionResult],
    full: bool,
    folder: &OutputFolder,
    progress: &Progress,
    wall_s: f64,
) -> Result<Outcome, CliError> {
    progress.stage("write");
    let report = report(sections, &typed());
    let files = ReportFiles::without_case(folder, "verify", report)?;
    let checks: Vec<&Check> = sections.iter().flat_map(|s| &s.checks).collect();
    let information = sections.iter().flat_map(|s| &s.information);
    let result = VerifyResult {
        head: result_head("verify", progress, wall_s, Some(&files.tables)),
        full,
        checks: checks.clone(),
        information: information.collect(),
        orders: sections.iter().find_map(|section| section.orders.as_deref()),
    };
    let (path, json) = folder.write_json("verify.json", &result)?;
    let failed: Vec<String> = checks.iter().filter(|check| !check.ok).map(|check| check.line()).collect();
    Ok(Outcome {
        summary: summary(sections),
        result: json,
        written: [vec![path], files.paths].concat(),
        verdict: match failed.is_empty() {
            true => Ok(()),
            false => Err(CliError::failed(failed.join("; ")).with_help(
                "the program does not compute here what it computed where it was made: please report it with verify.json",
            )),
        },
    })
}

fn report(sections: &[SectionResult], command: &str) -> Report {
    let [good, total] = good_of(sections);
    let verdict = crate::report::Verdict::of(good == total);
    let mut report = Report::new("Verification", command, env!("CARGO_PKG_VERSION"))
        .subtitle("The program against published numbers and closed forms")
        .judgement("Checks", format!("{good} of {total} pass"), verdict);
    for section in sections {
        let [good, total] = good_of(std::slice::from_ref(section));
        let verdict = crate::report::Verdict::of(good == total);
        report = report.headline(&section.title, format!("{good} of {total}"), verdict);
        for part in section.sections() {
            report = report.section(part);
        }
    }
    report
}

/// How many checks pass, and how many there are.
fn good_of(sections: &[SectionResult]) -> [usize; 2] {
    let checks = || sections.iter().flat_map(|section| &section.checks);
    [checks().filter(|check| check.ok).count(), checks().count()]
}

fn summary(sections: &[SectionResult]) -> String {
    let mut lines = Vec::new();
    for section in sections {
        if !section.checks.is_empty() {
            lines.push(section.check_table().plain());
        }
        if let Some(table) = section.information_table() {
            lines.push(table.plain());
        }
    }
    let [good, total] = good_of(sections);
    lines.push(format!("{good} of {total} checks pass"));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::verification::section::Kind;
    use crate::report::Section;
    use serde_json::Value;

    fn section(reference: f64) -> SectionResult {
        let kind = Kind { unit: "N", source: "hand", assumptions: "none", reason: "two digits" };
        let check = |name: &str, reference| kind.check(name, 2.0, reference, 0.01);
        SectionResult {
            report: vec![Section::new("").paragraph("Told beside.")],
            ..SectionResult::of_checks("Numbers", vec![check("right", 2.0), check("judged", reference)])
        }
    }

    fn concluded(name: &str, reference: f64) -> (Outcome, OutputFolder) {
        let path = std::env::temp_dir().join(format!("plummer-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        let folder = OutputFolder::at(&path);
        folder.claim("verify", false).unwrap();
        let progress = Progress::new(false);
        let sections = [section(reference)];
        let outcome = conclude(&sections, false, &folder, &progress, 0.5).unwrap();
        (outcome, folder)
    }

    #[test]
    fn a_reference_that_is_missed_is_named_and_everything_is_written_all_the_same() {
        let (outcome, folder) = concluded("verify-bad", 2.1);
        let error = outcome.verdict.unwrap_err();
        let what = error.to_string();
        assert_eq!(error.exit_code(), 1);
        assert!(what.starts_with("judged: 2.0") && !what.contains("right"), "{what}");
        assert!(outcome.summary.ends_with("1 of 2 checks pass"), "{}", outcome.summary);
        let text = std::fs::read_to_string(folder.path.join("verify.json")).unwrap();
        let json: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["checks"][0]["ok"], true);
        assert_eq!(json["checks"][1]["ok"], false);
        assert!(json.get("orders").is_none());
        let page = std::fs::read_to_string(folder.path.join("report.html")).unwrap();
        assert!(page.contains("1 of 2 pass") && page.contains("Told beside."));
        std::fs::remove_dir_all(folder.path).unwrap();
    }

    #[test]
    fn references_that_are_met_are_good() {
        let (outcome, folder) = concluded("verify-good", 2.01);
        assert_eq!(outcome.verdict, Ok(()));
        std::fs::remove_dir_all(folder.path).unwrap();
    }
}
