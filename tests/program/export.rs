//! `plummer export` and the tables of `plummer modes` from outside: files that other readers understand, of earlier results
//! where there are some, and nothing replaced by accident.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use nalgebra::DMatrix;
use plummer::files::FileDigest;
use plummer::formats::{
    Op4Matrix, read_mode_shapes, read_op4, read_superelement_npz, write_modes_npz, write_superelement_npz,
};
use serde_json::Value;
use sprs::TriMat;
use sprs::io::read_matrix_market;
use vtkio::Vtk;
use vtkio::model::{Attribute, DataSet, Piece};

use super::common::errors;

const RING: &str = "[ring]\nnodes = 24\nouter_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n";
const SPRINGS: &str = "supports = [{ from_deg = 180, to_deg = 360, spring = { x = 1e5, y = 1e5 } }]\n";
const TIE: &str = "tie = { group = \"bore\", centre = [0, 0, 0], axis = [0, 0, 1], zero_deg = [1, 0, 0] }\n";
const MODES: &str = "[modes]\ncount = 6\n";

/// A folder of this test's own: a ring alone, a plane housing, and both coupled.
fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("export-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/ring_6_9_coarse.msh");
    fs::copy(mesh, folder.join("a.msh")).unwrap();
    let housing = "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\n\
        plane = { assumption = \"stress\", thickness = 4e-3 }\n\
        parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
        supports = [{ group = \"lower\", spring = { x = 1e5, y = 1e5 } }]\n";
    let write = |name: &str, text: String| fs::write(folder.join(name), text).unwrap();
    write("ring.toml", format!("{RING}{SPRINGS}{MODES}"));
    write("housing.toml", format!("{housing}{MODES}"));
    write("coupled.toml", format!("{housing}{RING}{TIE}{MODES}"));
    folder
}

fn plummer(folder: &Path, words: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plummer")).current_dir(folder).args(words.split(' ')).output().unwrap()
}

fn good(folder: &Path, words: &str) -> String {
    let output = plummer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words}: {}", errors(&output));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, words: &str) -> String {
    let output = plummer(folder, words);
    assert_eq!(output.status.code(), Some(2), "{words}");
    assert!(output.stdout.is_empty(), "{words}");
    errors(&output)
}

/// Names the shapes that stand in a folder now in its `modes.json`, as if they had been computed so.
fn name_again(out: &Path) {
    let path = out.join("modes.json");
    let mut result = json(path.clone());
    let digest = FileDigest::of_file(&out.join("modes.npz")).unwrap();
    result["arrays"]["modes.npz"] = digest.sha256.into();
    fs::write(path, result.to_string()).unwrap();
}

fn json(path: PathBuf) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap().iter();
    list.map(|number| number.as_f64().unwrap()).collect()
}

fn mtx(path: &Path) -> DMatrix<f64> {
    let matrix: TriMat<f64> = read_matrix_market(path).unwrap();
    let dense = matrix.to_csr::<usize>().to_dense();
    DMatrix::from_fn(dense.nrows(), dense.ncols(), |row, column| dense[(row, column)])
}

/// An array of an archive by the reader `npyz`.
fn array<T: npyz::Deserialize>(path: &Path, name: &str) -> Vec<T> {
    let mut zip = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut bytes = Vec::new();
    let mut entry = zip.by_name(&format!("{name}.npy")).unwrap();
    entry.read_to_end(&mut bytes).unwrap();
    npyz::NpyFile::new(&bytes[..]).unwrap().into_vec().unwrap()
}

/// Lowest frequencies of `K x = (2 pi f)^2 M x`, Hz, by a dense solver.
fn frequencies(k: &DMatrix<f64>, m: &DMatrix<f64>, count: usize) -> Vec<f64> {
    let l = m.clone().cholesky().unwrap().l();
    let half = l.solve_lower_triangular(k).unwrap();
    let whole = l.solve_lower_triangular(&half.transpose()).unwrap();
    let mut values: Vec<f64> = whole.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    let hz = |value: &f64| value.max(0.0).sqrt() / std::f64::consts::TAU;
    values.iter().take(count).map(hz).collect()
}

/// Point fields of a grid with three components, by the reader `vtkio`; and its numbers of points and cells.
fn grid(path: &Path) -> (BTreeMap<String, Vec<f64>>, usize, usize) {
    let DataSet::UnstructuredGrid { pieces, .. } = Vtk::import(path).unwrap().data else {
        panic!("an unstructured grid");
    };
    let [Piece::Inline(piece)] = pieces.as_slice() else {
        panic!("one piece");
    };
    let fields = piece.data.point.iter().map(|field| match field {
        Attribute::DataArray(array) => (array.name.clone(), array.data.cast_into().unwrap()),
        Attribute::Field { .. } => panic!("an array"),
    });
    (fields.collect(), piece.num_points(), piece.cells.num_cells())
}

/// Matrices of ring, housing and both, read by `sprs` and `npyz` and solved densely, have the frequencies of
/// `modes.json`.
#[test]
fn matrices_have_the_frequencies_of_modes() {
    let folder = scratch("matrices");
    for case in ["ring", "housing", "coupled"] {
        good(&folder, &format!("modes {case}.toml --quiet"));
        good(&folder, &format!("export {case}.toml --to mtx"));
        good(&folder, &format!("export out/{case} --to npz"));
        let out = folder.join("out").join(case);
        let (k, m) = (mtx(&out.join("stiffness.mtx")), mtx(&out.join("mass.mtx")));
        let expected = numbers(&json(out.join("modes.json"))["frequencies_hz"]);
        assert_eq!(expected.len(), 6);
        for (found, expected) in frequencies(&k, &m, 6).iter().zip(&expected) {
            // a dense solver errs by 1e-15 of the largest eigenvalue, (2 pi 1e7 Hz)^2, and these lie above 1 kHz
            assert!((found / expected - 1.0).abs() < 1e-8, "{case} {found} {expected}");
        }
        let mut table = csv::Reader::from_path(out.join("dofs.csv")).unwrap();
        let rows: Vec<BTreeMap<String, String>> = table.deserialize().map(Result::unwrap).collect();
        assert_eq!(rows.len(), k.nrows());
        let last = rows.len() - 1;
        assert_eq!((&rows[last]["row"], &rows[last]["mtx_row"]), (&last.to_string(), &(last + 1).to_string()));
        let directions = array::<String>(&out.join("dofs.npz"), "direction");
        assert!(rows.iter().map(|row| &row["direction"]).eq(&directions));
        for (name, whole) in [("stiffness", &k), ("mass", &m)] {
            let path = out.join(format!("{name}.npz"));
            let (data, rows) = (array::<f64>(&path, "data"), array::<i32>(&path, "indices"));
            let offsets = array::<i32>(&path, "indptr");
            let mut found = DMatrix::zeros(whole.nrows(), whole.ncols());
            for (column, ends) in offsets.windows(2).enumerate() {
                for at in ends[0] as usize..ends[1] as usize {
                    found[(rows[at] as usize, column)] = data[at];
                }
            }
            // the upper triangle may differ from the lower one by a rounding
            assert!((found - whole).amax() < 1e-15 * whole.amax(), "{case} {name}");
        }
        let record = json(out.join("export.json"));
        assert_eq!(record["to"], "npz");
        assert_eq!(record["earlier"][0]["to"], "mtx");
        for file in record["files"].as_array().unwrap() {
            let size = fs::metadata(out.join(file["file"].as_str().unwrap())).unwrap().len();
            assert_eq!(file["bytes"], size);
        }
    }
}

/// Shapes of a folder come from its `modes.npz`, here with a frequency that no computation gives.
#[test]
fn shapes_of_earlier_results_are_not_solved_for_again() {
    let folder = scratch("shapes");
    good(&folder, "modes coupled.toml --quiet");
    let out = folder.join("out/coupled");
    let path = out.join("modes.npz");
    let mut shapes = read_mode_shapes(&path).unwrap();
    assert_eq!(shapes.count_points(), 160 + 24);
    shapes.frequencies_hz[1] = 123.25;
    write_modes_npz(&path, &shapes).unwrap();
    name_again(&out);
    let shown = good(&folder, "export out/coupled --to vtu");
    assert!(shown.contains("wrote out/coupled/modes.vtu\nwrote out/coupled/ring.vtu\n"), "{shown}");
    good(&folder, "export out/coupled --to uff --quiet");
    let (fields, points, cells) = grid(&out.join("modes.vtu"));
    assert_eq!((fields.len(), points, cells), (6, 160, 40));
    assert_eq!(fields["mode 2, 123.2500 Hz"], shapes.shapes[1][..480]);
    let (fields, points, cells) = grid(&out.join("ring.vtu"));
    assert_eq!((fields.len(), points, cells), (6, 24, 24));
    assert_eq!(fields["mode 2, 123.2500 Hz"], shapes.shapes[1][480..]);
    let of_housing = read_mode_shapes(&out.join("modes.uff")).unwrap();
    assert_eq!((of_housing.count_points(), of_housing.count_modes()), (160, 6));
    let of_ring = read_mode_shapes(&out.join("ring.uff")).unwrap();
    for (found, expected) in of_ring.shapes[1].iter().zip(&shapes.shapes[1][480..]) {
        // the format has six digits
        assert!((found - expected).abs() <= 1e-5 * expected.abs(), "{found} {expected}");
    }
    let record = json(out.join("export.json"));
    assert_eq!(record["results"], "out/coupled");
    assert!(record["stages_s"].get("eigen").is_none());
    // a case file is computed
    good(&folder, "export coupled.toml --to vtu --out fresh");
    let (fields, ..) = grid(&folder.join("fresh/modes.vtu"));
    assert!(!fields.contains_key("mode 2, 123.2500 Hz"));
    assert!(json(folder.join("fresh/export.json"))["stages_s"].get("eigen").is_some());
}

/// A node that no element uses, as gmsh leaves at the centre of an arc.
#[test]
fn unused_nodes_stay_out_of_the_files() {
    let folder = scratch("unused");
    let mesh = fs::read_to_string(folder.join("a.msh")).unwrap();
    let (head, rest) = mesh.split_once("$Nodes\n").unwrap();
    let (counts, rest) = rest.split_once('\n').unwrap();
    let counts: Vec<usize> = counts.split(' ').map(|n| n.parse().unwrap()).collect();
    let (blocks, nodes, last) = (counts[0] + 1, counts[1] + 1, counts[3] + 1);
    let entity = rest.split_once(" 0 ").unwrap().0;
    let more = format!("{entity} 0 1\n{last}\n0 0 0\n$EndNodes");
    let rest = rest.replacen("$EndNodes", &more, 1);
    let mesh = format!("{head}$Nodes\n{blocks} {nodes} {} {last}\n{rest}", counts[2]);
    fs::write(folder.join("a.msh"), mesh).unwrap();
    good(&folder, "modes housing.toml --quiet");
    good(&folder, "export out/housing --to uff");
    good(&folder, "export out/housing --to vtu");
    let out = folder.join("out/housing");
    assert_eq!(read_mode_shapes(&out.join("modes.npz")).unwrap().count_points(), 161);
    assert_eq!(read_mode_shapes(&out.join("modes.uff")).unwrap().count_points(), 160);
    assert_eq!(grid(&out.join("modes.vtu")).1, 160);
}

#[test]
fn results_that_do_not_fit_are_refused() {
    let folder = scratch("misfit");
    assert_eq!(
        refused(&folder, "export . --to vtu"),
        "error: . has no modes.json and modes.npz: expected a folder with results of `plummer modes`, or a case file\n\
         help: run `plummer modes CASE.toml --out .` first\n"
    );
    good(&folder, "modes coupled.toml --quiet");
    let out = folder.join("out/coupled");
    let path = out.join("modes.npz");
    let whole = read_mode_shapes(&path).unwrap();
    let mut fewer = whole.clone();
    fewer.points.as_mut().unwrap().pop();
    fewer.shapes.iter_mut().for_each(|shape| shape.truncate(3 * 183));
    write_modes_npz(&path, &fewer).unwrap();
    name_again(&out);
    let error = refused(&folder, "export out/coupled --to uff");
    assert!(
        error.starts_with("error: out/coupled/modes.npz does not fit the case: expected 160 nodes of the mesh and 24 of the ring, found 183 nodes\n"),
        "{error}"
    );
    let mut moved = whole.clone();
    moved.points.as_mut().unwrap()[5][1] += 1e-6;
    write_modes_npz(&path, &moved).unwrap();
    name_again(&out);
    let error = refused(&folder, "export out/coupled --to vtu");
    assert!(error.contains("does not fit the case: expected node "), "{error}");
    let error = refused(&folder, "export out/coupled --to mtx --set ring.nodes=12");
    assert!(error.starts_with("error: --set changes the case, but out/coupled holds"), "{error}");
    fs::write(&path, "damaged").unwrap();
    assert!(refused(&folder, "export out/coupled --to vtu").contains("is not the file that"));
    name_again(&out);
    assert!(refused(&folder, "export out/coupled --to vtu").contains("expected a NumPy archive"));
    fs::rename(folder.join("coupled.toml"), folder.join("moved.toml")).unwrap();
    let error = refused(&folder, "export out/coupled --to mtx");
    assert!(error.contains("names the case file coupled.toml, which is not there"), "{error}");
    fs::write(out.join("modes.json"), "{ \"case\": 3 }").unwrap();
    let error = refused(&folder, "export out/coupled --to mtx");
    assert!(error.contains("expected the case file's name under \"case\", found 3"), "{error}");
    assert!(!out.join("export.json").exists() && !out.join("modes.vtu").exists());
}

#[test]
fn files_in_the_way_are_refused() {
    let folder = scratch("refused");
    assert!(
        refused(&folder, "export ring.toml --to stl")
            .contains("[possible values: vtu, uff, mtx, npz, op4, dmig, inp, mbdyn]")
    );
    assert!(!folder.join("out").exists());
    let out = folder.join("out/ring");
    fs::create_dir_all(&out).unwrap();
    fs::write(out.join("mass.mtx"), "kept").unwrap();
    let error = refused(&folder, "export ring.toml --to mtx");
    assert!(
        error.starts_with("error: out/ring/mass.mtx is the result of an earlier run\nhelp: replace it with --force")
    );
    assert_eq!(fs::read_to_string(out.join("mass.mtx")).unwrap(), "kept");
    assert!(!out.join("stiffness.mtx").exists());
    assert_eq!(good(&folder, "export ring.toml --to mtx --force --quiet"), "");
    assert_eq!(mtx(&out.join("mass.mtx")).nrows(), 72);
    let shown = good(&folder, "export ring.toml --to mtx --force --json");
    let shown: Value = serde_json::from_str(&shown).unwrap();
    assert_eq!(shown, json(out.join("export.json")));
    assert_eq!(shown["earlier"], serde_json::json!([]));
    let names: Vec<&Value> = shown["files"].as_array().unwrap().iter().map(|file| &file["file"]).collect();
    assert_eq!(names, ["stiffness.mtx", "mass.mtx", "dofs.csv"]);
    let left: Vec<String> = fs::read_dir(&out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".partial"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
}

/// Modes do not depend on what a response or a title says; on the ring they do.
#[test]
fn results_stay_those_of_a_case_that_gained_a_table() {
    let folder = scratch("gained");
    good(&folder, "modes coupled.toml --quiet");
    let text = fs::read_to_string(folder.join("coupled.toml")).unwrap();
    let response = "[damping]\nmodal = 0.02\n[frf]\nband_hz = [0, 20000]\n\
        from = [{ name = \"load\", ring_deg = 270, direction = [0, -1, 0] }]\n\
        [[sensors]]\nname = \"P1\"\nring_deg = 90\ndirection = [0, 1, 0]\n";
    fs::write(folder.join("coupled.toml"), format!("title = \"Other\"\n{text}{response}")).unwrap();
    good(&folder, "export out/coupled --to uff");
    fs::write(folder.join("coupled.toml"), text.replace("5.37e-6", "5.38e-6")).unwrap();
    let error = refused(&folder, "export out/coupled --to vtu");
    assert!(
        error.contains("out/coupled/modes.json was computed with values that differ from those in coupled.toml now\n")
    );
}

/// Every table of the report is a file with whole numbers, and the report's head names the mesh by its digest.
#[test]
fn tables_lie_beside_the_report() {
    let folder = scratch("tables");
    good(&folder, "modes housing.toml --quiet");
    let out = folder.join("out/housing");
    let result = json(out.join("modes.json"));
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    let tables: Vec<&str> = result["tables"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert_eq!(tables.len(), report.matches("class=\"csv\"").count());
    for name in &tables {
        assert!(report.contains(name), "{name}");
    }
    let table = tables.iter().find(|name| name.contains("-eigenfrequencies")).unwrap();
    let mut rows = csv::Reader::from_path(out.join(table)).unwrap();
    let column = rows.headers().unwrap().iter().position(|title| title == "Frequency [Hz]").unwrap();
    let found: Vec<f64> = rows.records().map(|row| row.unwrap()[column].parse().unwrap()).collect();
    // every bit of what the archive has
    let shapes = read_mode_shapes(&out.join("modes.npz")).unwrap();
    assert_eq!(found, shapes.frequencies_hz);
    let digest = FileDigest::of_file(&folder.join("a.msh")).unwrap().sha256;
    assert_eq!(result["meshes"], serde_json::json!([{ "path": "a.msh", "sha256": digest }]));
    assert!(report.contains(&format!("SHA-256 {digest}")));
    // what others put there stays, whatever its name
    fs::write(out.join("tables/modes-99-old.csv"), "mine").unwrap();
    fs::write(out.join("tables/notes.csv"), "mine").unwrap();
    let shown = good(&folder, "modes housing.toml --force");
    assert!(shown.contains("wrote out/housing/tables\n"), "{shown}");
    assert!(out.join("tables/modes-99-old.csv").exists());
    assert!(out.join("tables/notes.csv").exists());
}

/// A pillow block on its feet with a ring of 8 nodes.
fn write_solid(folder: &Path) {
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/pedestal.msh");
    fs::copy(mesh, folder.join("b.msh")).unwrap();
    let text = "[housing]\nmesh = \"b.msh\"\nlength_unit = \"mm\"\n\
        parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
        supports = [{ group = \"feet\", fixed = [\"x\", \"y\", \"z\"] }]\n\
        [condense]\nfixed_interface_modes = 6\n";
    let ring = RING.replace("24", "8");
    let solid = format!("{text}{ring}{TIE}[[sensors]]\nname = \"a\"\npoint = [0, 10e-3, 0]\ndirection = [0, 1, 0]\n");
    fs::write(folder.join("solid.toml"), solid).unwrap();
}

/// The condensed housing as OUTPUT4 with its rows, and as the data of MBDyn's modal element.
#[test]
fn a_condensed_housing_is_exported() {
    let folder = scratch("condensed");
    good(&folder, "condense coupled.toml --quiet --set condense.fixed_interface_modes=10");
    let out = folder.join("out/coupled");
    let record = read_superelement_npz(&out.join("superelement.npz")).unwrap();
    let shown = good(&folder, "export coupled.toml --to op4 --set condense.fixed_interface_modes=10");
    assert!(shown.contains("wrote out/coupled/superelement.op4\nwrote out/coupled/superelement_dofs.csv\n"), "{shown}");
    let matrices = read_op4(&out.join("superelement.op4")).unwrap();
    let names: Vec<&str> = matrices.iter().map(Op4Matrix::name).collect();
    assert_eq!(names, ["KAA", "MAA", "BSET", "BANDHZ", "COMPLHZ"]);
    // x, y and the rotation about z of each node of the ring
    let boundary = matrices[2].dense().unwrap();
    assert_eq!((boundary.nrows(), boundary.ncols()), (72, 2));
    assert_eq!([3, 4, 5].map(|row| (boundary[(row, 0)], boundary[(row, 1)])), [(1.0, 1.0), (1.0, 2.0), (1.0, 6.0)]);
    assert_eq!(matrices[0].dense().unwrap(), record.stiffness);
    assert_eq!(matrices[1].dense().unwrap(), record.mass);
    let mut table = csv::Reader::from_path(out.join("superelement_dofs.csv")).unwrap();
    let rows: Vec<BTreeMap<String, String>> = table.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), record.order());
    assert_eq!((rows[4]["body"].as_str(), rows[4]["node"].as_str()), ("ring", "1"));
    assert_eq!(rows[4]["direction"], "y");
    assert_eq!(rows[72]["body"], "modal");
    let export = json(out.join("export.json"));
    assert_eq!((&export["to"], export["files"].as_array().unwrap().len()), (&"op4".into(), 2));
    good(&folder, "export coupled.toml --to op4 --set condense.fixed_interface_modes=10");
    let other = refused(&folder, "export coupled.toml --to op4");
    assert!(other.starts_with("error: out/coupled/superelement.op4 is the result of an earlier run of other values"));
    let shown = good(&folder, "export coupled.toml --to dmig --set condense.fixed_interface_modes=10");
    assert!(shown.contains("wrote out/coupled/superelement.bdf\n"), "{shown}");
    let bulk = fs::read_to_string(out.join("superelement.bdf")).unwrap();
    let cards = |name: &str| bulk.lines().filter(|line| line.split(' ').next() == Some(name)).count();
    // 24 ring nodes of three coordinates, ten modes, two matrices
    assert_eq!((3 * cards("GRID*") + cards("SPOINT"), cards("SPOINT"), cards("DMIG")), (record.order(), 10, 2));
    // held by its feet: no inertia
    write_solid(&folder);
    let shown = good(&folder, "export solid.toml --to mbdyn");
    assert!(shown.contains("held by its supports: `clamped` in MBDyn's joint"), "{shown}");
    let text = fs::read_to_string(folder.join("out/solid/superelement.fem")).unwrap();
    // the ring's nodes and, as the whole mesh is too much, those of the bore and of the sensor
    assert!(text.contains("ring0") && text.contains("ring7"), "names");
    let refusals = [("ring.toml", "a ring alone"), ("housing.toml", "a housing that nothing is attached to")];
    for (case, found) in refusals {
        for format in ["op4", "dmig", "mbdyn"] {
            assert_eq!(
                refused(&folder, &format!("export {case} --to {format}")),
                format!(
                    "error: --to {format} writes a condensed housing: expected [housing] with a mesh, and ring.tie or \
                     condense.interface, found {found}\nhelp: --to mtx and --to npz write matrices that are not condensed\n"
                )
            );
        }
    }
}

/// Modes in the place of the ring's coordinates: what is written leads back to these, and what needs them says so.
#[test]
fn an_interface_is_reduced() {
    let folder = scratch("interface");
    // nothing holds ring and housing: three rigid motions, and two elastic modes below 100 kHz
    let set = "--set housing.supports=[] --set condense.fixed_interface_modes=10 --set accuracy.band_hz=[0,100000]";
    good(&folder, &format!("condense coupled.toml --quiet {set}"));
    let out = folder.join("out/coupled");
    let path = out.join("superelement.npz");
    let whole = read_superelement_npz(&path).unwrap();
    let shown =
        good(&folder, &format!("condense coupled.toml --force --compare-full {set} --set condense.interface_modes=20"));
    assert!(shown.contains("20 modes of the interface in place of its coordinates"), "{shown}");
    let reduced = read_superelement_npz(&path).unwrap();
    assert_eq!((whole.order(), reduced.order()), (82, 30));
    let back = reduced.interface_recovery.as_ref().unwrap();
    assert_eq!(back.labels, whole.interface);
    // k_cc = R^T k_bb R, but for the rigid motions' round-off
    let bb = |a: &plummer::numerics::linalg::DenseMatrix, n: usize| a.submatrix(0, 0, n, n).to_owned();
    for (own, of_whole) in [(&reduced.stiffness, &whole.stiffness), (&reduced.mass, &whole.mass)] {
        let product = back.modes.transpose() * bb(of_whole, 72) * &back.modes;
        let difference = (product - bb(own, 20)).norm_max();
        assert!(difference < 1e-9 * own.norm_max(), "{difference:e}");
    }
    let result = json(out.join("condense.json"));
    let of_interface = &result["interface_reduction"];
    assert_eq!(of_interface["modes"], 20);
    assert_eq!(numbers(&of_interface["frequencies_hz"])[..3], [0.0; 3]);
    let checks = result["checks"].as_array().unwrap();
    let named = |name: &str| checks.iter().any(|check| check["name"] == name);
    assert!(named("rigid motions carried") && !named("static interface"));
    let rises = numbers(&of_interface["relative_rise"]);
    assert_eq!((rises.len(), &rises[..3]), (5, &[0.0; 3][..]));
    // found 3.1e-8; round-off of a frequency is below 1e-11
    assert!(rises[3..].iter().all(|rise| (1e-9..1e-6).contains(rise)), "{rises:?}");
    let sizes = result["error_by_size"].as_array().unwrap();
    let errors = |key: &str| -> Vec<f64> { sizes.iter().filter_map(|row| row[key].as_f64()).collect() };
    let reduced_errors: Vec<f64> =
        (sizes.iter()).filter_map(|row| row["interface_reduced"]["error"].as_f64()).collect();
    for errors in [errors("plain"), errors("enhanced"), reduced_errors] {
        assert!(errors.len() > 5, "{errors:?}");
        assert!(errors.last() < errors.first(), "{errors:?}");
    }
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    for title in ["The reduced interface", "Error against size"] {
        assert!(report.contains(title), "{title}");
    }
    // neither Nastran nor a ring can take modes
    assert_eq!(
        refused(&folder, "export coupled.toml --to op4 --set condense.interface_modes=20"),
        "error: --to op4 writes the displacements of an interface, by which others attach it: expected \
         condense.interface_modes = \"none\", found modes in their place\n\
         help: --set 'condense.interface_modes=\"none\"'; superelement.npz of `plummer condense` has the modes\n"
    );
    let text = format!("[housing]\nsuperelement = \"out/coupled/superelement.npz\"\n{RING}{MODES}");
    fs::write(folder.join("npz.toml"), text).unwrap();
    let error = refused(&folder, "modes npz.toml");
    assert!(error.contains("found 20 modes of an interface of 72 coordinates"), "{error}");
    // three rigid motions in the plane
    let few = plummer(&folder, &format!("condense coupled.toml --force {set} --set condense.interface_modes=2"));
    let error = String::from_utf8(few.stderr).unwrap();
    assert!(error.contains("2 modes of the interface are kept, expected at least 3"), "{error}");
}

/// A superelement written by `condense`, or its OUTPUT4 file, in the housing's place.
#[test]
fn a_superelement_takes_the_housing_s_place() {
    let folder = scratch("import");
    good(&folder, "condense coupled.toml --quiet --set condense.fixed_interface_modes=40");
    good(&folder, "export coupled.toml --to op4 --quiet --set condense.fixed_interface_modes=40");
    good(&folder, "modes coupled.toml --quiet");
    let full = numbers(&json(folder.join("out/coupled/modes.json"))["frequencies_hz"]);
    for kind in ["npz", "op4"] {
        let text = format!("[housing]\nsuperelement = \"out/coupled/superelement.{kind}\"\n{RING}{MODES}");
        fs::write(folder.join(format!("{kind}.toml")), text).unwrap();
        let shown = good(&folder, &format!("modes {kind}.toml"));
        assert!(shown.contains("Not available without its mesh"), "{shown}");
        let unlabelled = shown.contains("Only their number was checked.");
        assert_eq!(unlabelled, kind == "op4", "{shown}");
        let result = json(folder.join(format!("out/{kind}/modes.json")));
        assert_eq!(result["mass_kg"], Value::Null);
        assert_eq!(result["superelement"]["interface_dof"], 72);
        let found = numbers(&result["frequencies_hz"]);
        for (found, full) in found.iter().zip(&full) {
            // what condensing on forty vectors costs; 0.014 without any
            assert!((found / full - 1.0).abs() < 0.01, "{found} {full}");
        }
        let report = fs::read_to_string(folder.join(format!("out/{kind}/report.html"))).unwrap();
        assert!(report.contains("Not available without its mesh"));
        let shown = good(&folder, &format!("condense {kind}.toml"));
        assert!(shown.contains("checks passed: 7 of 7"), "{shown}");
        assert!(!folder.join(format!("out/{kind}/superelement.npz")).exists());
        // the ring's line and the matrices are there, its housing is not
        good(&folder, &format!("export {kind}.toml --to vtu --quiet"));
        assert!(!folder.join(format!("out/{kind}/modes.vtu")).exists());
        good(&folder, &format!("export {kind}.toml --to mtx --quiet"));
        let k = mtx(&folder.join(format!("out/{kind}/stiffness.mtx")));
        let m = mtx(&folder.join(format!("out/{kind}/mass.mtx")));
        for (own, found) in frequencies(&k, &m, 6).iter().zip(&found) {
            // two dense solvers
            assert!((own / found - 1.0).abs() < 1e-8, "{own} {found}");
        }
        let error = refused(&folder, &format!("export {kind}.toml --to op4"));
        assert!(error.contains("found a superelement, which is condensed already"), "{error}");
        let error = refused(&folder, &format!("modes {kind}.toml --set ring.nodes=10 --force"));
        // without labels it is the block structure that tells
        let told = match kind {
            "npz" => "interface coordinates for ring.nodes = 10 (x, y, about_z of each)",
            _ => "check \"k_bq = 0\"",
        };
        assert!(error.contains(told), "{error}");
    }
    // a stiffness between interface and mode
    let path = folder.join("out/coupled/superelement.npz");
    let mut record = read_superelement_npz(&path).unwrap();
    // far below what would make it negative
    let both = record.stiffness[(0, 0)] * record.stiffness[(72, 72)];
    record.stiffness[(0, 72)] = 1e-6 * both.sqrt();
    record.stiffness[(72, 0)] = record.stiffness[(0, 72)];
    write_superelement_npz(&path, &record).unwrap();
    let error = refused(&folder, "modes npz.toml --force");
    assert!(
        error.starts_with("error: housing.superelement: out/coupled/superelement.npz: check \"k_bq = 0\" ("),
        "{error}"
    );
    let checked = plummer(&folder, "condense npz.toml --force");
    assert_eq!(checked.status.code(), Some(1));
}

/// Thrust, preload and loads in front of the bearings ask nothing of the structure.
#[test]
fn a_case_in_space_is_exported() {
    let folder = scratch("space");
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/machines/spindle.toml");
    let case = case.display();
    good(&folder, &format!("export {case} --to mtx --out out --quiet"));
    let dofs = fs::read_to_string(folder.join("out/dofs.csv")).unwrap();
    let stiffness: TriMat<f64> = read_matrix_market(folder.join("out/stiffness.mtx")).unwrap();
    assert_eq!(stiffness.rows(), dofs.lines().count() - 1);
    good(&folder, &format!("export {case} --to op4 --out out --quiet --set condense.fixed_interface_modes=4"));
    let matrices = read_op4(&folder.join("out/superelement.op4")).unwrap();
    let boundary = matrices.iter().find(|matrix| matrix.name() == "BSET").unwrap();
    assert_eq!(boundary.dense().unwrap().nrows(), 2 * 24 * 6);
}
