//! Lines of a plot that belong together, for the reader to mark: a fundamental with its harmonics and side lines.

use serde::{Deserialize, Serialize};

use super::layout::AxisView;
use super::plot::Plot;
use super::svg_plot::COLOURS;

/// A fundamental whose harmonics k f, k = 1, 2, ..., the reader can mark in the page, read and move together. Drawings and
/// prints without a script do not show it; fixed lines are [`Marker`](super::Marker)s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Family {
    /// What it belongs to ("outer race").
    pub name: String,
    /// The fundamental, in the x axis' unit; one that is not above 0 is left out.
    pub fundamental: f64,
    /// Side lines at k f +- m times a spacing.
    pub sides: Option<Sides>,
    /// Its colour, that of a marker's family.
    pub family: usize,
}

/// Lines beside the harmonics of a family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sides {
    /// Whose spacing it is ("shaft").
    pub name: String,
    /// The spacing, in the x axis' unit, above 0.
    pub spacing: f64,
}

impl Family {
    /// A family with its fundamental in the x axis' unit, in the colour of a marker's family.
    pub fn new(name: impl Into<String>, fundamental: f64, family: usize) -> Self {
        Self {
            name: name.into(),
            fundamental,
            sides: None,
            family,
        }
    }

    /// The family with side lines, `spacing` in the x axis' unit.
    #[must_use]
    pub fn sides(mut self, name: impl Into<String>, spacing: f64) -> Self {
        let name = name.into();
        self.sides = Some(Sides { name, spacing });
        self
    }

    fn is_shown(&self) -> bool {
        is_positive(self.fundamental)
    }
}

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

impl Plot {
    /// The plot with a family more that the reader can mark.
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.families.push(family);
        self
    }
}

/// In shown units.
#[derive(Debug, Serialize)]
pub(super) struct FamilyData<'a> {
    at: f64,
    colour: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    sides: Option<SidesData<'a>>,
}

#[derive(Debug, Serialize)]
struct SidesData<'a> {
    name: &'a str,
    spacing: f64,
}

/// Names of the families that a plot offers, in the order of [`data`].
pub(super) fn names(plot: &Plot) -> Vec<&str> {
    let shown = plot.families.iter().filter(|family| family.is_shown());
    shown.map(|family| family.name.as_str()).collect()
}

/// What the script of the page needs of the families.
pub(super) fn data<'a>(plot: &'a Plot, x: &AxisView) -> Vec<FamilyData<'a>> {
    let shown = plot.families.iter().filter(|family| family.is_shown());
    let sides = |family: &'a Family| {
        let sides = family.sides.as_ref()?;
        is_positive(sides.spacing).then(|| SidesData {
            name: &sides.name,
            spacing: sides.spacing / x.factor,
        })
    };
    shown
        .map(|family| FamilyData {
            at: family.fundamental / x.factor,
            colour: family.family % COLOURS,
            sides: sides(family),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::layout::Layout;
    use super::super::{Abscissa, Axis, Curve, Report, Section};
    use super::*;

    fn plot() -> Plot {
        let even = Abscissa::Even {
            start: 0.0,
            step: 100.0,
        };
        Plot::new(
            "Envelope spectrum",
            Axis::new("Frequency", "Hz"),
            Axis::new("Amplitude", "m/s^2"),
        )
        .curve(Curve::new("P1", even, vec![1.0; 401]))
        .family(Family::new("</script><b>race", 2500.0, 8).sides("shaft & co", 500.0))
        .family(Family::new("nothing", 0.0, 1))
        .family(Family::new("cage", 400.0, 1).sides("none", f64::NAN))
    }

    #[test]
    fn families_are_in_shown_units_and_those_without_frequency_left_out() {
        let plot = plot();
        let layout = Layout::of(&plot).expect("a valid plot");
        assert_eq!(names(&plot), ["</script><b>race", "cage"]);
        let data = serde_json::to_value(data(&plot, &layout.x)).expect("JSON");
        // 40 kHz are shown, in kHz; the eighth of six colours is the third
        let sides = serde_json::json!({"name": "shaft & co", "spacing": 0.5});
        assert_eq!(
            data,
            serde_json::json!([{"at": 2.5, "colour": 2, "sides": sides}, {"at": 0.4, "colour": 1}])
        );
    }

    #[test]
    fn the_page_offers_families_by_name_as_text() {
        let html = |plot| {
            let report = Report::new("t", "c", "0").section(Section::new("S").plot(plot));
            report.to_html().expect("a valid report")
        };
        let page = html(plot());
        let option = |text| format!("<option value=\"{text}</option>");
        assert!(page.contains(&option("0\">&lt;&#x2f;script&gt;&lt;b&gt;race")));
        assert!(page.contains(&option("1\">cage")));
        assert!(page.contains("aria-label=\"Cursors of figure 1\""));
        assert!(page.contains("<label hidden>A [kHz] <input type=\"number\""));
        assert!(!page.contains("<b>race"));
        let mut bare = plot();
        bare.families.clear();
        let page = html(bare);
        assert!(!page.contains("<select") && page.contains("Cursors A, B"));
    }
}
