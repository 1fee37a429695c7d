//! `plummer init`: a case file from a mesh.

use super::analyze::catalogue_orders;
use super::inspect::verdict;
use super::output::json;
use super::{CliError, InitArguments, Options, Outcome, write_atomic};
use crate::app::case::{BUILT_IN_MATERIALS, bearing_help};
use crate::app::commands::init::{
    CatalogueEntry, CatalogueResult, Draft, DraftRequest, DraftResult, MaterialSummary, MaterialsResult,
};
use crate::app::commands::result::VERSION;
use crate::app::shell_word::shell_word;
use crate::bearing::catalogue::{CatalogueBearing, Source};
use crate::report::significant;
use std::fmt::Write as _;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Writes a case file for a mesh, or lists the bearings or the materials.
///
/// # Errors
/// [`CliError`] when the mesh cannot be read, makes no case or has elements that no command takes, the bearing is not known, or the file exists or cannot be written.
pub(crate) fn init(asked: &InitArguments, options: &Options) -> Result<Outcome, CliError> {
    let Some(mesh) = &asked.mesh else {
        return if asked.list_materials { list_materials() } else { list() };
    };
    let bearing = asked.bearing.as_deref().map(named).transpose()?;
    let case = case_file(mesh, options)?;
    let folder = case.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let mesh_in_case = path_from(folder, mesh);
    let title = case.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let request = DraftRequest {
        mesh,
        mesh_in_case: &mesh_in_case,
        title: &title,
        length_unit: asked.length_unit,
        bearing,
        straighten: asked.straighten,
    };
    let (mut draft, inspection) = Draft::of_mesh(request)?;
    let left_out = asked.bearing.as_deref().and_then(CatalogueBearing::left_out);
    draft.findings.extend(left_out.map(|parts| format!("Nothing is taken from {parts} of --bearing.")));
    if let Err(error) = verdict(&inspection) {
        let what = format!("{}: {error}; no case file was written", mesh.display());
        return Err(CliError { help: error.help, ..CliError::input(what) });
    }
    if case.exists() && !options.force && fs::read_to_string(&case).ok().as_ref() != Some(&draft.text) {
        return Err(CliError::input(format!("{} exists", case.display()))
            .with_help("replace it with --force, or name another file with --out"));
    }
    fs::create_dir_all(folder).map_err(|error| CliError::folder(folder, &error))?;
    write_atomic(&case, draft.text.as_bytes())?;
    let next = format!("Look through the guesses, then: plummer modes {}", shell_word(&case.to_string_lossy()));
    Ok(Outcome {
        summary: [draft.findings.as_slice(), &[next]].concat().join("\n"),
        result: json(&DraftResult { plummer: VERSION, command: "init", mesh, case: &case, draft: &draft })?,
        written: vec![case],
        verdict: Ok(()),
    })
}

fn named(name: &str) -> Result<&'static CatalogueBearing, CliError> {
    CatalogueBearing::named(name).ok_or_else(|| {
        CliError::input(format!("--bearing: found \"{name}\", expected a bearing of the catalogue"))
            .with_help(bearing_help(name))
    })
}

/// `--out`, else the mesh's name with another ending in the current folder.
fn case_file(mesh: &Path, options: &Options) -> Result<PathBuf, CliError> {
    let beside = || Path::new(mesh.file_stem().unwrap_or_default()).with_extension("toml");
    let path = options.out.clone().unwrap_or_else(beside);
    if path.file_name().is_none() || path.is_dir() {
        return Err(CliError::input(format!(
            "{}: found no file name, expected that of a case file (--out FILE.toml)",
            path.display()
        )));
    }
    Ok(path)
}

/// Lists the bearings of the catalogue.
fn list() -> Result<Outcome, CliError> {
    let entry = |bearing| CatalogueEntry::of(bearing, catalogue_orders(bearing, 0.0).ok());
    Ok(Outcome {
        summary: table(),
        result: json(&CatalogueResult {
            plummer: VERSION,
            command: "init",
            bearings: CatalogueBearing::all().iter().map(entry).collect(),
        })?,
        written: Vec::new(),
        verdict: Ok(()),
    })
}

/// Lists the materials that a case may name.
fn list_materials() -> Result<Outcome, CliError> {
    let materials: Vec<MaterialSummary> = BUILT_IN_MATERIALS.iter().map(MaterialSummary::from).collect();
    let mut text = String::from(
        "materials that a case may name, at 20 \u{b0}C; a table [materials.NAME] of the case takes the place of one\n\
         name             E, GPa  Poisson  kg/m^3  range and source",
    );
    for material in &materials {
        // writing to a String cannot fail
        let _ = write!(
            text,
            "\n{:<15} {:>7} {:>8} {:>7}  {}\n{:41}{}",
            material.name,
            significant(1e-9 * material.young_pa, 3),
            material.poisson,
            material.density_kg_m3,
            material.range,
            "",
            material.source
        );
    }
    Ok(Outcome {
        summary: text,
        result: json(&MaterialsResult { plummer: VERSION, command: "init", materials })?,
        written: Vec::new(),
        verdict: Ok(()),
    })
}

fn table() -> String {
    let mut text = String::from(
        "deep groove ball bearings, lengths in mm, mass in kg; orders per revolution of the shaft, without contact angle\n\
         name   bore  outer  width  balls  ball diameter  pitch diameter  mass    BPFO   BPFI    BSF    FTF  source",
    );
    for bearing in CatalogueBearing::all() {
        let [bore, outer, width, ball, pitch] =
            [bearing.bore, bearing.outer_diameter, bearing.width, bearing.ball_diameter, bearing.pitch_diameter]
                .map(|length| 1e3 * length);
        let star = if bearing.pitch_published { ' ' } else { '*' };
        let orders = catalogue_orders(bearing, 0.0)
            .map_or([f64::NAN; 4], |orders| [orders.outer, orders.inner, orders.ball_spin, orders.cage]);
        let orders = orders.map(|order| format!(" {order:>6.4}")).concat();
        // writing to a String cannot fail
        let _ = write!(
            text,
            "\n{:<5} {bore:>5.0} {outer:>6.0} {width:>6.0} {:>6} {ball:>14.3} {pitch:>14.2}{star} {:>6.3}{orders}  {}",
            bearing.name,
            bearing.balls,
            bearing.mass,
            bearing.source.name()
        );
    }
    text.push_str("\n* not published: the mean of bore and outer diameter");
    text.push_str("\nUsual, no maker's: groove radii of 0.52 (inner) and 0.53 (outer) of the ball's diameter. Races' radii are half of pitch less or plus ball diameter.");
    text.push_str("\nBSF is the spin of a ball: a flaw on it strikes both races, twice a spin, so that --orders takes BSF=s or ball=2s.");
    for source in Source::ALL {
        let _ = write!(text, "\n{}: {}", source.name(), source.citation());
    }
    text.push_str(
        "\nMakers choose the balls themselves: those of another maker's bearing of the same name may differ.",
    );
    text
}

/// The path of a file relative to a folder, with `/` between its parts; the absolute path where they have nothing in common but
/// the root, or where one of them cannot be looked up. The folder need not exist.
fn path_from(folder: &Path, file: &Path) -> String {
    let absolute = |path: &Path| std::path::absolute(path).map(|path| plain(&path));
    let (Ok(folder), Ok(file)) = (absolute(folder), absolute(file)) else {
        return file.display().to_string();
    };
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let shared = folder.components().take(common).any(|part| matches!(part, Component::Normal(_)));
    if !shared {
        return file.display().to_string();
    }
    let up = folder.components().skip(common).map(|_| "..".into());
    let down = file.components().skip(common).map(|part| part.as_os_str().to_string_lossy());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// Without `.` and `..`; a link to a folder is followed by nobody, so that the name stays the one that was typed.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::path_from;

    #[test]
    fn files_are_named_from_a_folder() {
        for (folder, file, expected) in [
            (".", "a.msh", "a.msh"),
            (".", "./b/../meshes/a.msh", "meshes/a.msh"),
            ("cases", "meshes/a.msh", "../meshes/a.msh"),
            ("cases/new", "cases/a.msh", "../a.msh"),
            ("cases/new/one", "cases/a.msh", "../../a.msh"),
            ("/x/y", "/x/z/a.msh", "../z/a.msh"),
            ("/x/y", "/z/a.msh", "/z/a.msh"),
        ] {
            assert_eq!(path_from(Path::new(folder), Path::new(file)), expected, "{folder} {file}");
        }
    }
}
