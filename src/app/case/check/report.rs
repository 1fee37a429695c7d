//! The entries of a report's head.

use super::super::ReportDetails;
use super::range::kept;
use super::rule::{BrokenRule, Rule};

/// Longest entry in characters: what fits on the first page with the inputs beside it.
const LONGEST: usize = 500;

/// The title stands in the head of every page.
pub(super) fn title(title: &str) -> Result<(), BrokenRule> {
    let wrong = title.chars().find(|c| c.is_control());
    kept(wrong.is_none(), "title", || {
        Rule::found(format!("the control character {}", wrong.unwrap_or_default().escape_debug()), "one line of text")
    })
}

pub(in crate::app::case) fn report(details: &ReportDetails) -> Result<(), BrokenRule> {
    for (key, text) in details.entries() {
        let Some(text) = text else { continue };
        let at = || format!("report.{key}");
        kept(!text.trim().is_empty(), at(), || {
            Rule::found("an empty text", "some text").with_help("leave the key out where there is nothing to say")
        })?;
        let length = text.chars().count();
        kept(length <= LONGEST, at(), || Rule::found(format!("{length} characters"), &format!("{LONGEST} at most")))?;
        let lines = if key == "remark" { "text" } else { "one line of text" };
        let wrong = text.chars().find(|c| c.is_control() && !(key == "remark" && *c == '\n'));
        kept(wrong.is_none(), at(), || {
            Rule::found(format!("the control character {}", wrong.unwrap_or_default().escape_debug()), lines)
        })?;
    }
    Ok(())
}
