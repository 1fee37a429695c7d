//! What a sweep is to compute.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::Axis;
use super::axis::EXAMPLES;
use crate::app::case::{Case, Purpose};
use crate::app::commands::run::unfinished::RunIdentity;
use crate::app::error::ComputeError;

/// Most points of a sweep: each has a folder.
const MOST_POINTS: usize = 100_000;

/// What is computed at each point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SweptCommand {
    /// `plummer run`.
    #[default]
    Run,
    /// `plummer modes`.
    Modes,
}

impl SweptCommand {
    /// The command's name on the command line; its result file is `NAME.json`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Modes => "modes",
        }
    }

    /// What a case is to be used for at each point.
    pub(crate) fn purpose(self) -> Purpose {
        match self {
            Self::Run => Purpose::Run,
            Self::Modes => Purpose::Modes,
        }
    }
}

/// What a sweep is to compute: a case, and the values that some of its keys take.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// What is computed at each point.
    pub command: SweptCommand,
    /// The case file, an absolute path.
    pub case: PathBuf,
    /// Its content, arguments and meshes, and the program's version.
    pub identity: RunIdentity,
    /// `KEY=VALUE` arguments of all points, in order.
    pub set: Vec<String>,
    /// What is varied; the last axis varies fastest.
    pub axes: Vec<Axis>,
}

/// One point of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepPoint {
    /// From 1.
    pub number: usize,
    /// The value of each axis.
    pub values: Vec<String>,
    /// `KEY=VALUE` arguments: those of all points, then the axes'.
    pub set: Vec<String>,
}

impl Plan {
    /// Plans a sweep of a case that has been read.
    ///
    /// # Errors
    /// [`ComputeError::Input`] if nothing is varied, a key is varied twice or has a value beside, or there are more points than 100,000;
    /// that of a mesh that cannot be read; [`ComputeError::Failed`] if the working folder is unknown.
    pub fn new(case: &Case, command: SweptCommand, axes: Vec<Axis>) -> Result<Self, ComputeError> {
        if axes.is_empty() {
            let what = "nothing is varied: expected at least one --vary KEY=VALUES";
            return Err(ComputeError::input(what, EXAMPLES));
        }
        for (place, axis) in axes.iter().enumerate() {
            let key = &axis.key;
            let both = |other: &Axis| other.sets(&axis.key) || axis.sets(&other.key);
            if axes[..place].iter().any(both) {
                let what = format!("--vary {key}: the key is varied twice");
                return Err(ComputeError::input(what, "put all its values into one --vary"));
            }
            let mut set = case.source.set.iter();
            let set = set.find(|set| set.split_once('=').is_some_and(|(key, _)| axis.sets(key)));
            if let Some(set) = set {
                let what = format!("--vary {key}: --set {set} gives the same key one value");
                return Err(ComputeError::input(what, "leave one of the two out"));
            }
        }
        let count = axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.values.len()));
        if count.is_none_or(|count| count > MOST_POINTS) {
            let what = format!("the product of all --vary has more than {MOST_POINTS} points");
            return Err(ComputeError::input(what, "fewer values, or several sweeps"));
        }
        let path = &case.source.path;
        Ok(Self {
            command,
            case: std::path::absolute(path).map_err(ComputeError::io(path))?,
            identity: RunIdentity::of(case, command.name())?,
            set: case.source.set.clone(),
            axes,
        })
    }

    /// Number of points: the product of the axes' lengths.
    pub(crate) fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// A point by its number, 1 to [`Plan::count`].
    pub(crate) fn point(&self, number: usize) -> SweepPoint {
        let mut rest = number.saturating_sub(1);
        let mut places = vec![0; self.axes.len()];
        for (place, axis) in places.iter_mut().zip(&self.axes).rev() {
            *place = rest % axis.values.len();
            rest /= axis.values.len();
        }
        let values: Vec<String> =
            (self.axes.iter().zip(places)).map(|(axis, place)| axis.values[place].clone()).collect();
        let varied = self.axes.iter().zip(&values);
        let varied = varied.map(|(axis, value)| format!("{}={value}", axis.key));
        SweepPoint { number, set: self.set.iter().cloned().chain(varied).collect(), values }
    }

    /// All points in the order of their numbers.
    pub(crate) fn points(&self) -> impl Iterator<Item = SweepPoint> + '_ {
        (1..=self.count()).map(|number| self.point(number))
    }

    /// The case of a point.
    ///
    /// # Errors
    /// [`crate::app::case::CaseError`] when the point's values make no valid case, or none for the command.
    pub(crate) fn case_at(&self, point: &SweepPoint, text: &str) -> Result<Case, crate::app::case::CaseError> {
        let case = Case::from_source(crate::app::case::Source {
            path: self.case.clone(),
            text: text.to_owned(),
            set: point.set.clone(),
        })?;
        case.ready_for(self.command.purpose())?;
        Ok(case)
    }

    /// Whether a result is of a point's case: of its arguments and, while the case file is as it was planned, of its values.
    ///
    /// # Errors
    /// [`ComputeError::Input`] if it is not.
    pub(super) fn belongs(
        &self,
        point: &SweepPoint,
        file: &Path,
        result: &serde_json::Value,
    ) -> Result<(), ComputeError> {
        let set: Option<Vec<String>> = serde_json::from_value(result["set"].clone()).ok();
        let command = self.command.name();
        let planned = Case::load(&self.case, &self.set).ok();
        let planned = planned.filter(|case| self.identity.has_values_of(case, command));
        let case = planned.and_then(|case| self.case_at(point, &case.source.text).ok());
        let expected = case.and_then(|case| case.digest(command));
        let other = set.as_ref().is_some_and(|set| *set != point.set);
        let same = match (expected, result["case_digest"].as_str()) {
            (Some(expected), Some(found)) => expected == found,
            _ => !other,
        };
        if same {
            return Ok(());
        }
        let found = match other {
            true => set.unwrap_or_default(),
            false => vec!["the same keys of another case".to_owned()],
        };
        let words = |set: &[String]| set.iter().map(|set| format!("--set {set}")).collect::<Vec<_>>().join(" ");
        let (number, expected, found) = (point.number, words(&point.set), words(&found));
        let folder = file.parent().unwrap_or(file).display();
        Err(ComputeError::input(
            format!("{} is not the result of point {number}: expected {expected}, found {found}", file.display()),
            format!("remove the folder {folder} and compute the point again with --resume"),
        ))
    }

    /// The folder of a point in that of the sweep.
    pub(crate) fn folder(&self, sweep: &Path, number: usize) -> PathBuf {
        // as many digits as the last one has, so that lists of files are in order
        let digits = self.count().to_string().len();
        sweep.join(format!("{number:0digits$}"))
    }

    /// What is not the same in another plan, in words.
    pub(crate) fn changes(&self, now: &Self) -> Vec<String> {
        let mut changes = self.identity.changes(&now.identity);
        if self.command != now.command {
            let (then, now) = (self.command.name(), now.command.name());
            changes.push(format!("--command {then}, now --command {now}"));
        }
        let text = |axes: &[Axis]| -> Vec<String> {
            let one = |axis: &Axis| format!("--vary {}={}", axis.key, axis.values.join(","));
            axes.iter().map(one).collect()
        };
        let (then, now) = (text(&self.axes), text(&now.axes));
        if then != now {
            changes.push(format!("{}, now {}", then.join(" "), now.join(" ")));
        }
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Case, ComputeError, Plan, SweptCommand};
    use std::path::Path;

    fn axes(arguments: &[&str]) -> Vec<Axis> {
        let parse = |argument: &&str| Axis::parse(argument).unwrap();
        arguments.iter().map(parse).collect()
    }

    fn plan(arguments: &[&str]) -> Result<Plan, ComputeError> {
        let case = Case::example("tadina2011/beam", &["modes.count=3"]);
        Plan::new(&case, SweptCommand::Modes, axes(arguments))
    }

    #[test]
    fn points_are_the_product_and_the_last_axis_is_fastest() {
        let plan = plan(&["ring.nodes=36,72", "ring.shear=true,false", "bearing.balls=7"]).unwrap();
        assert_eq!(plan.count(), 4);
        let points: Vec<_> = plan.points().collect();
        let values: Vec<String> = points.iter().map(|point| point.values.join(" ")).collect();
        assert_eq!(values, ["36 true 7", "36 false 7", "72 true 7", "72 false 7"]);
        assert_eq!(points[2].number, 3);
        assert_eq!(points[2].set, ["modes.count=3", "ring.nodes=72", "ring.shear=true", "bearing.balls=7"]);
        assert!(plan.case.is_absolute());
        assert_eq!(plan.folder(Path::new("s"), 3), Path::new("s/3"));
    }

    #[test]
    fn folders_are_in_order() {
        let plan = plan(&["ring.nodes=10:109:100"]).unwrap();
        assert_eq!(plan.folder(Path::new("s"), 7), Path::new("s/007"));
        assert_eq!(plan.folder(Path::new("s"), 100), Path::new("s/100"));
    }

    #[test]
    fn what_is_no_plan_is_refused() {
        let message = |arguments: &[&str]| {
            let error = plan(arguments).unwrap_err();
            assert!(error.is_input() && error.help().is_some());
            error.to_string()
        };
        assert_eq!(message(&[]), "nothing is varied: expected at least one --vary KEY=VALUES");
        let twice = message(&["bearing.defects[0].depth=1", "bearing.defects.0.depth=2"]);
        assert_eq!(twice, "--vary bearing.defects.0.depth: the key is varied twice");
        // the case is set to three modes
        for axis in ["modes.count=3,4", "modes=1,2"] {
            assert!(message(&[axis]).ends_with(": --set modes.count=3 gives the same key one value"), "{axis}");
        }
        let within = message(&["bearing.defects[0].depth=1", "bearing.defects=[]"]);
        assert_eq!(within, "--vary bearing.defects: the key is varied twice");
        let many = message(&["ring.nodes=1:1000:1000", "bearing.balls=1:101:101"]);
        assert_eq!(many, "the product of all --vary has more than 100000 points");
    }

    #[test]
    fn a_plan_is_a_file_and_changes_are_named() {
        let first = plan(&["ring.nodes=36,72"]).unwrap();
        let text = serde_json::to_string(&first).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), first);
        assert!(first.changes(&first).is_empty());
        let mut other = plan(&["ring.nodes=36"]).unwrap();
        other.command = SweptCommand::Run;
        assert_eq!(
            first.changes(&other),
            ["--command modes, now --command run", "--vary ring.nodes=36,72, now --vary ring.nodes=36"]
        );
    }
}
