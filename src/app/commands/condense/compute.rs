//! `plummer condense`: a housing as a superelement, with its error and its certificate.

use crate::app::case::{Case, InterfaceModes};
use crate::app::error::ComputeError;
use crate::app::scene::tie_price::{BorePrice, TIE_PRICE_MODES, TiePrice, bore_price, tie_price};
use crate::app::scene::{AssembledHousing, Boundary, CondensedHousing, doubts};
use crate::fe::assembly::SystemMatrices;
use crate::fe::modal::{Bore, FullModes, Mechanisms, ModeRange};
use crate::fe::model::CentreTie;
use crate::fe::reduction::{
    CharacteristicModes, Check, CraigBampton, ErrorEstimate, InterfaceReduction, InterfaceSize, LostFlexibility,
    SizeErrors, Superelement, check_craig_bampton, size_study,
};
use crate::numerics::Watch;
use crate::numerics::linalg::EigenProblem;
use std::f64::consts::TAU;

/// Agreement of two computations of one eigenvalue, relative, as frequencies: residuals below 1e-5 leave errors of the
/// order of their squares.
const SAME: f64 = 1e-7;

/// Errors of the reduction that are compared with their estimate: below it, both are the eigenvalues' own.
const ABOVE_ROUND_OFF: f64 = 1e-8;

/// A reduced interface and what it costs.
#[derive(Debug, Clone)]
pub struct ReducedInterface {
    /// The superelement on modes of the interface.
    pub reduction: InterfaceReduction,
    /// What the frequencies in the band rise by, relative; 0 of rigid modes.
    pub rises: Vec<f64>,
    /// Share of the interface's static flexibility that is lost.
    pub lost: LostFlexibility,
}

impl ReducedInterface {
    /// The largest rise of a frequency in the band; 0 without modes.
    pub(crate) fn largest_rise(&self) -> f64 {
        self.rises.iter().copied().fold(0.0, f64::max)
    }

    /// A reduction of the interface onto some of its modes, with the estimate of both reductions; `estimate` is that of the whole
    /// interface.
    ///
    /// # Errors
    /// [`ComputeError::Reduction`] of the dense eigenvalue solver.
    fn of(
        reduction: InterfaceReduction,
        stage: &CondensedHousing,
        modes: &CharacteristicModes,
        estimate: &ErrorEstimate,
    ) -> Result<(Self, ErrorEstimate), ComputeError> {
        let attached = stage.boundary.attached();
        let (estimate, rises) = estimate.raised(&stage.condensed.basis, &reduction.coupled_values(attached)?);
        let lost = modes.lost_flexibility(reduction.kept());
        Ok((Self { reduction, rises, lost }, estimate))
    }
}

/// What is asked beside the superelement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// Nothing.
    None,
    /// Frequencies of the full model.
    Full,
}

/// Frequencies of the full model beside those of the reduced one.
#[derive(Debug, Clone, PartialEq)]
pub struct FullComparison {
    /// Of the full model in the band, Hz; rigid ones first.
    pub frequencies_hz: Vec<f64>,
    /// `(reduced - full) / full` of each; `None` for rigid modes.
    pub relative_errors: Vec<Option<f64>>,
    /// Smallest and largest of estimated / true error; `None` if no error is above round-off.
    pub effectivity: Option<[f64; 2]>,
    /// Errors of reductions of other sizes; none without an elastic mode in the band.
    pub sizes: Vec<SizeErrors>,
}

/// Result of the command.
#[derive(Debug, Clone)]
pub struct CondenseResult {
    /// The condensed housing.
    pub stage: CondensedHousing,
    /// Its interface on modes, if the case asks for it.
    pub interface: Option<ReducedInterface>,
    /// Errors in the band, of the interface's reduction too.
    pub estimate: ErrorEstimate,
    /// Its certificate.
    pub checks: Vec<Check>,
    /// The full model, if asked for.
    pub full: Option<FullComparison>,
    /// What the ring's rigid sections change, if the full model was asked for and a ring is tied.
    pub tie_price: Option<TiePrice>,
    /// What rigid centre nodes change, if the full model was asked for and there are any.
    pub bore_price: Option<Vec<BorePrice>>,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

impl CondenseResult {
    /// The superelement that is handed on.
    pub(crate) fn superelement(&self) -> &Superelement {
        match &self.interface {
            Some(interface) => &interface.reduction.superelement,
            None => &self.stage.condensed.superelement,
        }
    }
}

/// Condenses the housing of a case.
///
/// # Errors
/// [`ComputeError`] of the stages that it goes through.
pub fn compute_condense(
    case: &Case,
    comparison: Comparison,
    watch: &impl Watch,
) -> Result<CondenseResult, ComputeError> {
    // a case with neither tie nor other interface was refused before
    let stage = CondensedHousing::build(case, watch)?.ok_or(ComputeError::NothingToCondense)?;
    watch.stage("check");
    let band_hz = stage.choice.band_hz;
    let CraigBampton { substructure, basis, .. } = &stage.condensed;
    let matrices = stage.matrices();
    let size = match case.condense.interface_modes {
        InterfaceModes::None => None,
        InterfaceModes::Count(count) => Some(InterfaceSize::Count(count)),
        InterfaceModes::UpToHz(hz) => Some(InterfaceSize::UpTo(hz)),
    };
    let checked = || -> Result<_, ComputeError> {
        let modes = size.map(|_| characteristic_modes(&stage, &matrices)).transpose()?;
        let sized = modes.as_ref().zip(size);
        let reduction =
            sized.map(|(modes, size)| InterfaceReduction::new(&stage.condensed, modes, size)).transpose()?;
        let rigid = stage.rigid_motions();
        let mut checks = check_craig_bampton(&stage.condensed, reduction.as_ref(), &matrices, &rigid, band_hz)?;
        name_mechanisms(&mut checks, &stage.housing, &stage.boundary)?;
        Ok((modes, reduction, checks))
    };
    let AssembledHousing { mesh, model, .. } = &stage.housing;
    let (estimate, (checked, doubts)) = rayon::join(
        || ErrorEstimate::of(substructure, basis, stage.boundary.attached(), band_hz),
        || rayon::join(checked, || doubts(case, Some((mesh, model)), None)),
    );
    let (mut estimate, (modes, reduction, mut checks), doubts) = (estimate?, checked?, doubts?);
    let mut interface = None;
    if let Some((reduction, modes)) = reduction.zip(modes.as_ref()) {
        let (reduced, of_both) = ReducedInterface::of(reduction, &stage, modes, &estimate)?;
        (interface, estimate) = (Some(reduced), of_both);
    }
    checks.push(estimated_error(&estimate, case.target()));
    let (mut full, mut price, mut bores) = (None, None, None);
    if comparison == Comparison::Full {
        watch.stage("full model");
        let target = case.target();
        full = computed(compare(&stage, &estimate, watch), "frequencies", target, &mut checks)?;
        // with means over free nodes the interior is not what the partition leaves, and another factor has no such modes
        if stage.boundary.partition().mean.is_empty() {
            let own = fixed_interface(&stage, watch);
            let own = computed(own, "fixed-interface frequencies", SAME, &mut checks)?;
            checks.extend(own);
        }
        if let Some(found) = &mut full {
            let errors = found.relative_errors.iter().flatten();
            let largest = errors.fold(0.0, |largest: f64, error| largest.max(error.abs()));
            let what = "largest relative difference of the coupled frequencies in the band from the full model";
            checks.push(Check::at_most("frequencies", what, largest, target));
            let rigid = found.relative_errors.iter().take_while(|error| error.is_none()).count();
            if rigid < found.relative_errors.len() {
                let sizes = || {
                    let modes = modes.map_or_else(|| characteristic_modes(&stage, &matrices), Ok)?;
                    let substructure = &stage.condensed.substructure;
                    Ok(size_study(substructure, &modes, &found.frequencies_hz, rigid, watch)?)
                };
                found.sizes = computed(sizes(), "errors by size", target, &mut checks)?.unwrap_or_default();
            }
        }
        if stage.boundary.rings().is_some() {
            let found = tie_price(case, &stage.housing, TIE_PRICE_MODES, watch);
            price = computed(found, "price of the tie", target, &mut checks)?;
        }
        if let Boundary::Centres(centres) = &stage.boundary
            && centres.nodes.iter().any(|(_, node)| node.tie == CentreTie::Rigid)
        {
            bores = computed(bore_price(&stage, watch), "price of rigid bores", target, &mut checks)?;
        }
    }
    drop(matrices);
    Ok(CondenseResult { doubts, stage, interface, estimate, checks, full, tie_price: price, bore_price: bores })
}

/// What a step of the comparison with the full model found; where its computation fails, a check that fails.
fn computed<T>(
    found: Result<T, ComputeError>,
    name: &'static str,
    limit: f64,
    checks: &mut Vec<Check>,
) -> Result<Option<T>, ComputeError> {
    match found {
        Err(error) if !error.is_input() => {
            let what = format!("the comparison with the full model could not be computed: {error}");
            checks.push(Check::at_most(name, what, f64::INFINITY, limit));
            Ok(None)
        }
        found => found.map(Some),
    }
}

fn estimated_error(estimate: &ErrorEstimate, target: f64) -> Check {
    let poor = "the basis is too poor for an estimate: too many modes below the band's top are left out";
    let good = format!("largest estimated relative error of the {} frequencies in the band", estimate.modes.len());
    let (what, error) = if estimate.converged { (good, estimate.largest()) } else { (poor.to_owned(), f64::INFINITY) };
    Check::at_most("estimated error", what, error, target)
}

fn compare(
    stage: &CondensedHousing,
    estimate: &ErrorEstimate,
    watch: &impl Watch,
) -> Result<FullComparison, ComputeError> {
    let extent = ModeRange::Count(estimate.modes.len().max(1));
    let modes = FullModes::of(stage.full_matrices(), extent, None, watch)?;
    let rigid = modes.basis.rigid_modes;
    let full = &modes.basis.frequencies_hz;
    let errors = estimate.modes.iter().zip(full).enumerate();
    let relative_errors: Vec<Option<f64>> =
        errors.map(|(place, (mode, hz))| (place >= rigid).then(|| (mode.frequency_hz - hz) / hz)).collect();
    let pairs = relative_errors.iter().zip(&estimate.modes);
    let factors = pairs.filter_map(|(found, mode)| {
        let found = found.filter(|error| *error > ABOVE_ROUND_OFF)?;
        Some(mode.relative_error / found)
    });
    let effectivity = factors.fold(None, |range: Option<[f64; 2]>, factor| {
        let [low, high] = range.unwrap_or([factor; 2]);
        Some([low.min(factor), high.max(factor)])
    });
    Ok(FullComparison { frequencies_hz: full.clone(), relative_errors, effectivity, sizes: Vec::new() })
}

/// Fixed-interface frequencies of a factorisation of its own.
fn fixed_interface(stage: &CondensedHousing, watch: &impl Watch) -> Result<Check, ComputeError> {
    let basis = &stage.condensed.basis;
    let kept = basis.values().partition_point(|&value| value < basis.complete_below);
    let matrices = stage.matrices();
    let interior = &stage.boundary.partition().interior;
    let difference = match kept {
        0 => 0.0,
        _ => {
            watch.stage("order");
            let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, interior)?;
            watch.stage("fixed-interface modes");
            let pairs = problem.lowest_told(kept, &|part| watch.fraction(part))?;
            let both = pairs.values.iter().zip(basis.values());
            both.map(|(full, reduced)| ((reduced / full).sqrt() - 1.0).abs()).fold(0.0, f64::max)
        }
    };
    let top = basis.complete_below.sqrt() / TAU;
    Ok(Check::at_most(
        "fixed-interface frequencies",
        format!("largest relative difference from the full model of the {kept} below {top:.0} Hz"),
        difference,
        SAME,
    ))
}

/// All modes of the interface of a condensed housing with what is attached to it.
///
/// # Errors
/// [`ComputeError::Reduction`] of the dense eigenvalue solver.
fn characteristic_modes(
    stage: &CondensedHousing,
    matrices: &SystemMatrices,
) -> Result<CharacteristicModes, ComputeError> {
    let rigid = stage.rigid_motions().free_interface(&stage.condensed, matrices)?;
    Ok(CharacteristicModes::of(&stage.condensed.substructure, stage.boundary.attached(), &rigid)?)
}

/// Adds what of the whole housing can move to the check that says that something can.
///
/// # Errors
/// [`ComputeError::Modal`] for a mesh that is not the model's.
fn name_mechanisms(checks: &mut [Check], housing: &AssembledHousing, boundary: &Boundary) -> Result<(), ComputeError> {
    let Some(held) = checks.iter_mut().find(|check| check.name == "held" && !check.ok()) else {
        return Ok(());
    };
    let bore = boundary.rings().map_or(Bore::Empty, |(rings, tie)| Bore::Rings(tie, rings));
    let found = Mechanisms::find_in(&housing.mesh, &housing.model, &bore)?;
    for sentence in found.map_or(Vec::new(), |found| found.sentences()) {
        held.what = format!("{}; {sentence}", held.what);
    }
    Ok(())
}
