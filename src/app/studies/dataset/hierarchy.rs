//! Machines, the bearings that were mounted in them, and which part of the split each belongs to.
//!
//! Every specimen takes the machine, the fault and the part of which most is missing, by shares, with a little chance between those that
//! are close. So shares are met as nearly as the number allows, and more signals begin with the same ones.

use super::level::{Level, stream};
use super::spec::{DatasetSpec, SplitBy};
use std::collections::BTreeMap;

/// What damage a bearing has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Label {
    None,
    Outer,
    Inner,
    Ball,
    Several,
}

/// One machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Machine {
    /// Its place in `[[machines]]`, from 0.
    pub(super) entry: usize,
    /// Its part where machines are split, from 0.
    part: Option<usize>,
}

/// A bearing with its damage in a machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Specimen {
    /// The machine, from 0.
    pub(super) machine: usize,
    pub(super) label: Label,
    /// Train, validation or test, from 0.
    pub(super) part: usize,
}

/// All machines, and so many specimens.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Hierarchy {
    pub(super) machines: Vec<Machine>,
    pub(super) specimens: Vec<Specimen>,
}

impl Label {
    pub(crate) const ALL: [Self; 5] = [Self::None, Self::Outer, Self::Inner, Self::Ball, Self::Several];

    /// As the manifest has it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Outer => "outer",
            Self::Inner => "inner",
            Self::Ball => "ball",
            Self::Several => "several",
        }
    }
}

/// Takes the one of which most is missing.
fn take(shares: &[f64], given: &mut Vec<usize>, chance: impl FnMut() -> f64) -> usize {
    given.resize(shares.len(), 0);
    let (sum, total) = (shares.iter().sum::<f64>(), (given.iter().sum::<usize>() + 1) as f64);
    let missing = shares.iter().zip(given.iter()).zip(std::iter::repeat_with(chance));
    let missing = missing.map(|((share, given), chance)| match *share > 0.0 {
        true => share / sum * total - *given as f64 + chance,
        false => f64::NEG_INFINITY,
    });
    let most = missing.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
    let taken = most.map_or(0, |(place, _)| place);
    given[taken] += 1;
    taken
}

impl Hierarchy {
    pub(super) fn new(spec: &DatasetSpec, specimens: usize) -> Self {
        let shares = spec.split.shares();
        let chance = |level, index: usize, name: &str| {
            let mut stream = stream(spec.seed, level, index, name);
            move || stream.unit()
        };
        let (mut machines, mut parts) = (Vec::new(), Vec::new());
        for (entry, kind) in spec.machines.iter().enumerate() {
            for _ in 0..kind.count {
                let split = || take(&shares, &mut parts, chance(Level::Machine, machines.len(), "split"));
                let part = (spec.split.by == SplitBy::Machine).then(split);
                machines.push(Machine { entry, part });
            }
        }
        let weights: Vec<f64> = machines
            .iter()
            .map(|machine| spec.machines[machine.entry].weight / spec.machines[machine.entry].count as f64)
            .collect();
        let mut of_machines = Vec::new();
        let mut labels: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut splits: BTreeMap<Label, Vec<usize>> = BTreeMap::new();
        let specimen = |number: usize| {
            let machine = take(&weights, &mut of_machines, chance(Level::Specimen, number, "machine"));
            let fault = spec.fault_of(machines[machine].entry);
            let [outer, inner, ball] = fault.parts().map(|(_, part)| part.map_or(0.0, |part| part.share));
            let given = labels.entry(machine).or_default();
            let kinds = [fault.none, outer, inner, ball, fault.several];
            let label = Label::ALL[take(&kinds, given, chance(Level::Specimen, number, "label"))];
            let part = machines[machine].part.unwrap_or_else(|| {
                take(&shares, splits.entry(label).or_default(), chance(Level::Specimen, number, "split"))
            });
            Specimen { machine, label, part }
        };
        Self { specimens: (0..specimens).map(specimen).collect(), machines }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::case::{Document, Source};
    use std::collections::BTreeSet;

    const COUNT: usize = 300;

    fn hierarchy(split: &str, count: usize) -> Hierarchy {
        let text = format!(
            "seed = 5
            split = {{ train = 0.6, test = 0.4, {split} }}
            machines = [{{ case = \"a.toml\", count = 20, weight = 2 }}, {{ case = \"b.toml\", fault = {{ none = 1 }} }}]
            fault = {{ none = 2, outer = {{ share = 1 }}, inner = {{ share = 1 }} }}
            recorder = {{ rate_hz = 12000, duration_s = 1 }}"
        );
        let source = Source { text, ..Source::default() };
        Hierarchy::new(&Document::of_other(&source).unwrap().decode().unwrap(), count)
    }

    fn share(specimens: &[Specimen], is: impl Fn(&Specimen) -> bool) -> f64 {
        specimens.iter().filter(|specimen| is(specimen)).count() as f64 / specimens.len() as f64
    }

    #[test]
    fn shares_are_met_in_each_group() {
        let Hierarchy { machines, specimens } = hierarchy("by = \"specimen\"", COUNT);
        assert_eq!(machines.len(), 21);
        let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 0.04, "{found} {wanted}");
        near(share(&specimens, |specimen| machines[specimen.machine].entry == 0), 2.0 / 3.0);
        near(share(&specimens, |specimen| specimen.label == Label::Outer), 1.0 / 6.0);
        for label in [Label::None, Label::Outer, Label::Inner] {
            let of_label: Vec<Specimen> = specimens.iter().filter(|own| own.label == label).copied().collect();
            near(share(&of_label, |specimen| specimen.part == 2), 0.4);
        }
        assert!(specimens.iter().all(|specimen| specimen.part != 1), "nothing is for a part without a share");
        let parts: BTreeSet<(usize, usize)> = specimens.iter().map(|own| (own.machine, own.part)).collect();
        assert!(parts.len() > 30, "machines are in both parts");
    }

    #[test]
    fn a_machine_is_in_one_part_where_machines_are_split() {
        let specimens = hierarchy("by = \"machine\"", COUNT).specimens;
        let parts: BTreeSet<(usize, usize)> = specimens.iter().map(|own| (own.machine, own.part)).collect();
        let machines: BTreeSet<usize> = specimens.iter().map(|own| own.machine).collect();
        assert_eq!((parts.len(), machines.len()), (21, 21));
        let tested = parts.iter().filter(|(_, part)| *part == 2).count();
        assert!((7..=10).contains(&tested), "{tested}");
    }

    #[test]
    fn more_begin_with_the_same() {
        let [few, many] = [40, COUNT].map(|count| hierarchy("by = \"specimen\"", count).specimens);
        assert_eq!(few, many[..40]);
    }
}
