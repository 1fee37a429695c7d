//! Result files: `run.json`, `modes.json`, `signals.npz`.

use super::earlier_results::CASE_DIGEST;
use super::report_files::ReportFiles;
use super::{CliError, OutputFolder, Progress};
use crate::app::case::Case;
use crate::app::commands::analyze::{WindowAnalysis, WindowChange};
use crate::app::commands::condense::CondenseResult;
use crate::app::commands::modes::{ModesResult, Reading};
use crate::app::commands::run::choice::{ChosenPart, ModelChoice};
use crate::app::commands::run::{Recording, RunEnd, RunResult, SensorScalogram};
use crate::app::error::ComputeError;
use crate::app::scene::{CoupledStructure, ImportedHousing, ReducedInterface};
use crate::fe::reduction::{Bound, Check, SizeErrors};
use crate::files::FileDigest;
use crate::formats::{NpzWriter, write_modes_npz};
use crate::numerics::linalg::DenseMatrix;
use crate::system::LoadedPoint;
use crate::system::{BallsInertia, Column};
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// How long each stage took, s.
pub(super) fn stages_s(progress: &Progress) -> Value {
    let times = progress.times().into_iter();
    Value::Object(
        times
            .map(|stage| (stage.name, json!(stage.seconds)))
            .collect(),
    )
}

/// What every result carries.
pub(super) fn common(
    command: &str,
    case: &Case,
    progress: &Progress,
    wall_s: f64,
    meshes: &[FileDigest],
) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("plummer".to_owned(), json!(env!("CARGO_PKG_VERSION")));
    map.insert("command".to_owned(), json!(command));
    map.insert("case".to_owned(), json!(case.source.path));
    map.insert("set".to_owned(), json!(case.source.set));
    map.insert(CASE_DIGEST.to_owned(), json!(case.source.digest().ok()));
    map.insert("meshes".to_owned(), json!(meshes));
    map.insert("wall_s".to_owned(), json!(wall_s));
    map.insert("stages_s".to_owned(), stages_s(progress));
    map.insert("threads".to_owned(), json!(rayon::current_num_threads()));
    map
}

/// Doubts as lines of a summary.
pub(super) fn warnings(doubts: &[String]) -> impl Iterator<Item = String> {
    doubts.iter().map(|text| format!("warning: {text}"))
}

/// `run.json`.
pub(super) fn run_json<R: Recording>(
    case: &Case,
    result: &RunResult<R>,
    progress: &Progress,
    wall_s: f64,
    files: &ReportFiles,
) -> Value {
    let mut map = common("run", case, progress, wall_s, &files.meshes);
    map.insert("tables".to_owned(), json!(files.tables));
    let equilibrium = &result.scene.equilibrium;
    let balls = |value: fn(&crate::system::BallLoad) -> f64| -> Vec<f64> {
        equilibrium.balls.iter().map(value).collect()
    };
    let orders = result.scene.setup.geometry.orders();
    let fields = json!({
        "method": result.simulation.method.name(),
        "step_s": result.simulation.step_s(),
        "steps": result.simulation.statistics.steps,
        "rejected": result.simulation.statistics.rejected,
        "simulated_s": result.simulation.simulated_s,
        "realtime_factor": result.simulation.realtime_factor(),
        "stepping_s": result.simulation.stepping_s,
        "status": match &result.simulation.end {
            RunEnd::Complete => "complete".to_owned(),
            RunEnd::BlewUp(error) => error.to_string(),
        },
        "model": {
            "modes": result.simulation.modes,
            "of_modes": result.scene.stage.structure.dof(),
            "fixed_interface_modes": result.scene.stage.fixed_interface_modes,
            "balls": match result.choice.model.balls_inertia {
                BallsInertia::Dynamic => "dynamic",
                BallsInertia::QuasiStatic => "quasi-static",
            },
            "residual": result.simulation.residual,
            "why": choice_json(&result.choice)["parts"],
        },
        "estimated_error": result.choice.estimated_error,
        "estimate_held_s": result.horizon.map(|horizon| horizon.held_s),
        "estimate_from_s": result.horizon.map(|horizon| horizon.from_s),
        "estimate_looked_s": result.horizon.map(|horizon| horizon.looked_s),
        "energy": result.simulation.energy.map(|energy| json!({
            "input": energy.input_j(),
            "loads": energy.loads_j,
            "rotation": energy.rotation_j,
            "blending": energy.blending_j,
            "dissipated": energy.dissipated_j(),
            "modal_damping": energy.modal_damping_j,
            "contact_damping": energy.contact_damping_j,
            "stored": energy.stored_j,
            "exchanged": energy.exchanged_j,
            "balance_error": energy.error(),
        })),
        "equilibrium": {
            "shaft_m": equilibrium.shaft,
            "ball_angle_rad": balls(|ball| ball.angle),
            "inner_force_n": balls(|ball| ball.inner),
            "outer_force_n": balls(|ball| ball.outer),
            "residual_n": equilibrium.residual_n,
            "least_curvature_n_per_m": equilibrium.least_curvature,
            "shaft_stiffness_n_per_m": equilibrium.shaft_stiffness,
            "iterations": equilibrium.iterations,
        },
        "other_equilibria": result.statics.equilibria.iter().skip(1).map(|other| json!({
            "shaft_m": other.shaft,
            "inner_force_n": other.balls.iter().map(|ball| ball.inner).collect::<Vec<_>>(),
            "stable": other.is_stable(),
        })).collect::<Vec<_>>(),
        "defect_orders": {
            "cage": orders.cage,
            "outer": orders.outer,
            "inner": orders.inner,
            "ball": orders.ball_defect,
        },
        "windows": windows_json(&result.windows),
        "superelement": imported(&result.scene.stage),
        "not_analysed": result.not_analysed,
        "warnings": result.warnings,
    });
    extend(&mut map, fields);
    Value::Object(map)
}

/// What a result says of analysed windows.
pub(super) fn windows_json(windows: &[WindowAnalysis]) -> Value {
    windows.iter().map(window_json).collect()
}

/// What a result says of an analysed window.
pub(super) fn window_json(window: &WindowAnalysis) -> Value {
    let verdict = match &window.diagnosis {
        Ok(diagnosis) => json!({
            "sentence": diagnosis.sentence(),
            "envelope": diagnosis.envelope,
            "envelopes": diagnosis.envelopes,
            "turns": diagnosis.spectrum.turns,
            "speed_hz": diagnosis.speed_hz,
            "given_speed_hz": diagnosis.given_speed_hz,
            "speed_relative_error": diagnosis.speed_error,
            "speed_source": diagnosis.speed_source,
            "faults": diagnosis.faults,
            "unexplained": diagnosis.unexplained,
            "by_signal_alone": diagnosis.by_signal_alone,
        }),
        Err(reason) => json!({ "sentence": format!("no verdict: {reason}") }),
    };
    let outer = window.outer.iter().map(|(expected, found)| {
        json!({
            "expected_hz": expected,
            "found_hz": found.map(|found| found.0),
            "amplitude": found.map(|found| found.1),
        })
    });
    let mut json = json!({
        "sensor": window.sensor,
        "unit": window.unit,
        "whitened": window.whitened,
        "from": window.from,
        "to": window.to,
        "speed_hz": window.speed_hz,
        "rms": window.rms,
        "peak": window.peak,
        "kurtosis": window.kurtosis,
        "high_pass_hz": window.band.high_pass_hz,
        "band_hz": window.band.band_hz(),
        "kurtosis_of_band": window.band.found().map(|search| search.best.kurtosis),
        "kurtosis_limit": window.band.found().map(|search| search.best.limit),
        "outer_race": outer.collect::<Vec<_>>(),
        "lines_smeared_above_order": window.smeared_above,
        "envelope_peaks": window.peaks,
        "verdict": verdict,
    });
    if let Some(change) = &window.change {
        json["changes"] = change_json(change);
    }
    json
}

/// What a result says of a window beside an earlier signal.
fn change_json(change: &WindowChange) -> Value {
    json!({
        "baseline": change.baseline,
        "channel": change.channel,
        "from": change.window.from,
        "to": change.window.to,
        "speed_hz": change.speed_hz,
        "rms": change.rms,
        "peak": change.peak,
        "kurtosis": change.kurtosis,
        "lines": change.lines,
        "levels": change.levels,
        "warnings": change.warnings,
    })
}

/// Where, and the frequencies there.
fn loaded_points(points: &[LoadedPoint]) -> Vec<Value> {
    let frequencies = |point: &LoadedPoint| {
        let loaded = point.modes.as_ref()?;
        let hz = loaded.modes.iter().map(|mode| mode.frequency_hz);
        Some(hz.collect::<Vec<_>>())
    };
    let points = points.iter();
    points
        .map(|point| json!({ "at": point.at, "frequencies_hz": frequencies(point) }))
        .collect()
}

/// `modes.json`.
pub(super) fn modes_json(
    case: &Case,
    result: &ModesResult,
    progress: &Progress,
    wall_s: f64,
    files: &ReportFiles,
) -> Value {
    let mut map = common("modes", case, progress, wall_s, &files.meshes);
    map.insert("tables".to_owned(), json!(files.tables));
    let survey = &result.survey;
    let (basis, found) = (&survey.basis, survey.participation.as_ref());
    let fields = json!({
        "dof": survey.dof,
        "free_dof": survey.free_dof,
        "mass_kg": survey.mass.as_ref().map(|mass| mass.mass),
        "centroid_m": survey.mass.as_ref().map(|mass| mass.centroid()),
        "mass": survey.mass,
        "ball_pass": result.loaded_pass.as_ref().map(|pass| json!({
            "over_angle_rad": loaded_points(&pass.over_angle),
            "over_load": loaded_points(&pass.over_load),
        })),
        "frequencies_hz": result.base.unloaded_hz,
        "error_bounds_hz": basis.error_bounds_hz,
        "rigid_modes": basis.rigid_modes,
        "residuals": basis.residuals,
        "orthogonality": basis.orthogonality,
        "count_check": basis.count_check,
        "shift": basis.shift,
        "eigen_s": {
            "order": basis.times.order,
            "factor": basis.times.factor,
            "iterate": basis.times.iterate,
            "count": basis.times.count,
        },
        "participation_factors": found.map(|found| matrix(&found.factors)),
        "effective_mass": found.map(|found| matrix(&found.effective)),
        "effective_mass_sum": found.map(|found| &found.sums),
        "effective_mass_total": found.map(|found| &found.totals),
        "energy_shares": survey.shares,
        "free_motions": survey.mechanisms,
        "condensation_difference": result.base.condensation_difference,
        "superelement": result.structure.as_ref().and_then(imported),
        "loaded": loaded(&result.base),
        "expected": result.base.expected,
        "comparisons": result.comparisons,
        "convergence": result.convergence,
        "warnings": result.doubts,
        "variants": result.variants.iter().map(|variant| json!({
            "what": variant.what,
            "set": variant.set,
            "frequencies_hz": variant.unloaded_hz,
            "condensation_difference": variant.condensation_difference,
            "loaded": loaded(variant),
            "expected": variant.expected,
        })).collect::<Vec<_>>(),
    });
    extend(&mut map, fields);
    Value::Object(map)
}

/// What `condense.json` says beside what every result carries.
pub(super) fn condense_fields(result: &CondenseResult) -> Map<String, Value> {
    let (element, basis) = (
        &result.stage.condensed.superelement,
        &result.stage.condensed.basis,
    );
    let modes = &result.estimate.modes;
    let hz = |value: f64| value.max(0.0).sqrt() / std::f64::consts::TAU;
    let complete = basis.complete_below();
    let mut map = Map::new();
    extend(
        &mut map,
        json!({
            "interface_dof": element.interface_dof,
            "coordinates": result.superelement().order(),
            "interface_reduction": result.interface.as_ref().map(interface_reduction),
            "interior_dof": result.stage.condensed.substructure.interior_dof(),
            "fixed_interface_modes": basis.count() - basis.residual_vectors(),
            "residual_vectors": basis.residual_vectors(),
            "interior_frequencies_hz": basis.values().iter().map(|&v| hz(v)).collect::<Vec<_>>(),
            "complete_below_hz": complete.is_finite().then(|| hz(complete)),
            "band_hz": result.estimate.band_hz,
            "frequencies_hz": modes.iter().map(|mode| mode.frequency_hz).collect::<Vec<_>>(),
            "estimated_relative_error":
                modes.iter().map(|mode| mode.relative_error).collect::<Vec<_>>(),
            "estimate": {
                "largest": result.estimate.largest(),
                "converged": result.estimate.converged,
                "rounds": result.estimate.rounds,
                "out_of_band": result.estimate.out_of_band,
            },
            "checks": checks_json(&result.checks),
            "full_frequencies_hz": result.full.as_ref().map(|full| &full.frequencies_hz),
            "relative_error": result.full.as_ref().map(|full| &full.relative_errors),
            "effectivity": result.full.as_ref().and_then(|full| full.effectivity),
            "error_by_size": result.full.as_ref().map(|full| error_by_size(&full.sizes)),
            "tie_price": result.tie_price,
            "warnings": result.doubts,
        }),
    );
    map
}

/// What modes in place of an interface are, and what they cost.
fn interface_reduction(interface: &ReducedInterface) -> Value {
    let reduction = &interface.reduction;
    let hz = |value: &f64| value.max(0.0).sqrt() / std::f64::consts::TAU;
    json!({
        "modes": reduction.kept(),
        "frequencies_hz": reduction.values().iter().map(hz).collect::<Vec<_>>(),
        "first_left_out_hz": reduction.next().as_ref().map(hz),
        "relative_rise": interface.rises,
        "static_flexibility_lost": {
            "largest": interface.lost.largest,
            "mean": interface.lost.mean,
        },
    })
}

/// Largest relative errors of reductions by their size.
fn error_by_size(sizes: &[SizeErrors]) -> Vec<Value> {
    let row = |row: &SizeErrors| {
        json!({
            "size": row.size,
            "plain": row.plain,
            "enhanced": row.enhanced,
            "interface_reduced": row.reduced.map(|reduced| json!({
                "error": reduced.error,
                "interface_modes": reduced.interface_modes,
                "fixed_interface_modes": reduced.fixed_interface_modes,
                "residual_vectors": reduced.residual_vectors,
            })),
        })
    };
    sizes.iter().map(row).collect()
}

/// What `condense.json` says of a superelement from a file.
pub(super) fn imported_fields(imported: &ImportedHousing) -> Map<String, Value> {
    let mut map = Map::new();
    extend(
        &mut map,
        json!({
            "superelement": imported.path,
            "interface_dof": imported.element.interface_dof,
            "interior_frequencies_hz": imported.record.modal_hz,
            "notes": imported.notes,
            "checks": checks_json(&imported.checks),
        }),
    );
    map
}

fn checks_json(checks: &[Check]) -> Vec<Value> {
    let check = |check: &Check| {
        json!({
            "name": check.name,
            "what": check.what,
            "value": check.value,
            "limit": check.limit,
            "bound": match check.bound {
                Bound::AtMost => "at most",
                Bound::AtLeast => "at least",
            },
            "ok": check.ok(),
        })
    };
    checks.iter().map(check).collect()
}

/// What a result says of a superelement from a file.
fn imported(stage: &CoupledStructure) -> Option<Value> {
    let imported = stage.imported.as_ref()?;
    Some(json!({
        "path": imported.path,
        "interface_dof": imported.element.interface_dof,
        "modes": imported.element.modal_dof(),
        "notes": imported.notes,
    }))
}

/// Rows of a matrix.
fn matrix(a: &DenseMatrix) -> Vec<Vec<f64>> {
    (0..a.nrows())
        .map(|row| a.row(row).iter().copied().collect())
        .collect()
}

/// `modes.npz`: frequencies, nodes and shapes, ring nodes after those of the mesh.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_modes(
    folder: &OutputFolder,
    result: &ModesResult,
) -> Result<PathBuf, CliError> {
    let path = folder.path().join("modes.npz");
    write_modes_npz(&path, &result.mode_shapes()).map_err(ComputeError::from)?;
    Ok(path)
}

fn loaded(reading: &Reading) -> Value {
    reading.loaded.as_ref().map_or(Value::Null, |loaded| {
        json!({
            "without_stiffness": loaded.without_stiffness,
            "unstable": loaded.unstable,
            "modes": loaded.modes.iter().map(|mode| json!({
                "frequency_hz": mode.frequency_hz,
                "structure_share": mode.structure_share,
                "shaft_share": mode.shaft_share,
                "ball_share": mode.ball_share,
            })).collect::<Vec<_>>(),
        })
    })
}

/// A model's parts, with reasons and estimated errors.
pub(super) fn choice_json(choice: &ModelChoice) -> Value {
    let part = |part: &ChosenPart| {
        json!({
            "what": part.what,
            "chosen": part.chosen,
            "why": part.why,
            "estimated_error": part.estimated_error,
        })
    };
    json!({
        "command": "run --explain",
        "parts": choice.parts.iter().map(part).collect::<Vec<_>>(),
        "estimated_error": choice.estimated_error,
    })
}

fn extend(map: &mut Map<String, Value>, fields: Value) {
    if let Value::Object(fields) = fields {
        map.extend(fields);
    }
}

/// `signals.npz`.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_signals<R: Recording>(
    folder: &OutputFolder,
    result: &RunResult<R>,
) -> Result<PathBuf, CliError> {
    let path = folder.path().join("signals.npz");
    let record = &result.simulation.record;
    let (rows, balls, sensors) = (record.rows(), record.balls(), record.sensors());
    let write = || -> Result<(), ComputeError> {
        let mut npz = NpzWriter::create(&path)?;
        for column in Column::all(sensors.len()) {
            let name = match column {
                Column::Time => "time_s",
                Column::ShaftX => "shaft_x",
                Column::ShaftY => "shaft_y",
                Column::Sensor(sensor) => &sensors[sensor],
                Column::BallRadius => "ball_radius",
                Column::OuterForce => "outer_force",
                Column::InnerForce => "inner_force",
            };
            let shape: &[usize] = match column {
                Column::BallRadius | Column::OuterForce | Column::InnerForce => &[rows, balls],
                _ => &[rows],
            };
            let mut array = npz.begin(name, shape)?;
            record.read(column, 0..rows, &mut |piece| Ok(array.extend(piece)?))?;
            array.end()?;
        }
        Ok(npz.finish()?)
    };
    write()?;
    Ok(path)
}

/// `scalogram.npz`: `time_s`, `frequency_hz` and of each sensor its amplitudes \[frequencies x instants\], m/s^2.
///
/// # Errors
/// [`CliError`] if it cannot be written.
pub(super) fn write_scalograms(
    folder: &OutputFolder,
    scalograms: &[SensorScalogram],
) -> Result<Option<PathBuf>, CliError> {
    let Some(SensorScalogram {
        scalogram: axes, ..
    }) = scalograms.first()
    else {
        return Ok(None);
    };
    let path = folder.path().join("scalogram.npz");
    let (rows, columns) = (axes.frequency_hz.len(), axes.time_s.len());
    let write = || -> Result<(), ComputeError> {
        let mut npz = NpzWriter::create(&path)?;
        npz.array("time_s", &axes.time_s)?;
        npz.array("frequency_hz", &axes.frequency_hz)?;
        for of_sensor in scalograms {
            npz.matrix(
                &of_sensor.sensor,
                rows,
                columns,
                &of_sensor.scalogram.amplitude,
            )?;
        }
        Ok(npz.finish()?)
    };
    write()?;
    Ok(Some(path))
}
