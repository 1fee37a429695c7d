//! Assembly of K and M against a modal run: a box of Tet10 with about 250 000 degrees of freedom.
//!
//! `ASSEMBLY_DOF` sets the size, 250000 if absent; `RAYON_NUM_THREADS` the threads:
//! `RAYON_NUM_THREADS=2 cargo bench --bench assembly`. The modal run (20 modes, base fixed) is timed once and the
//! share of the assembly printed, with the peak of memory beside the size of K and M.

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use criterion::Criterion;
use peak_alloc::PeakAlloc;
use plummer::fe::assembly::SystemMatrices;
use plummer::fe::material::Material;
use plummer::fe::mesh::{
    ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
};
use plummer::fe::modal::{ModeRange, housing_modes};
use plummer::fe::model::{Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, SupportShare};
use plummer::numerics::linalg::SparseMatrix;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// A cube of 0.1 m in `cells` cubed cells of six tetrahedra; "box" is all of it, "base" its nodes at z = 0.
fn tet_box(cells: usize) -> Mesh {
    const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]];
    let side = 2 * cells + 1;
    let index = |p: [usize; 3]| p[0] + side * (p[1] + side * p[2]);
    let at = |i: usize| 0.05 * i as f64 / cells as f64;
    let nodes: Vec<[f64; 3]> =
        (0..side.pow(3)).map(|i| [at(i % side), at(i / side % side), at(i / side / side)]).collect();
    let mut connectivity = Vec::with_capacity(60 * cells.pow(3));
    for cell in 0..cells.pow(3) {
        let origin = [cell % cells, cell / cells % cells, cell / cells / cells].map(|i| 2 * i);
        for (number, path) in PATHS.into_iter().enumerate() {
            let mut corners = [origin; 4];
            for (step, axis) in path.into_iter().enumerate() {
                corners[step + 1..].iter_mut().for_each(|corner| corner[axis] += 2);
            }
            if number > 2 {
                corners.swap(1, 2); // the odd paths turn the other way round
            }
            connectivity.extend(corners.map(index));
            let middle = |[a, b]: [usize; 2]| index([0, 1, 2].map(|k| usize::midpoint(corners[a][k], corners[b][k])));
            connectivity.extend(EDGES.map(middle));
        }
    }
    let elements = 6 * cells.pow(3);
    let point = |block, tag| ElementBlock {
        kind: ElementKind::Point,
        tags: (tag..).take(side * side).collect(),
        connectivity: (0..side * side).collect(),
        entity: Entity { dimension: block, tag: 1 },
    };
    let ids = |block, count: usize| (0..count).map(move |index| ElementId { block, index });
    let group = |name: &str, dimension, nodes, elements| PhysicalGroup {
        name: name.to_owned(),
        dimension,
        tag: 1,
        nodes,
        elements,
    };
    Mesh {
        node_tags: (1..=nodes.len() as u64).collect(),
        groups: vec![
            group("base", 0, (0..side * side).collect(), ids(1, side * side).collect()),
            group("box", 3, (0..nodes.len()).collect(), ids(0, elements).collect()),
        ],
        blocks: vec![
            ElementBlock {
                kind: ElementKind::Tet10,
                tags: (1..=elements as u64).collect(),
                connectivity,
                entity: Entity { dimension: 3, tag: 1 },
            },
            point(0, elements as u64 + 1),
        ],
        nodes,
        format: MshFormat { version: MshVersion::V41, binary: false },
        notes: MeshNotes::default(),
        source: PathBuf::from("box of tetrahedra"),
    }
}

fn model(mesh: &Mesh) -> HousingModel {
    let aluminium = Material::new(70e9, 0.33, 2700.0).expect("valid");
    let base = HousingSupport {
        group: "base".to_owned(),
        constraint: Constraint::Fixed([true; 3]),
        share: SupportShare::PerNode,
    };
    let description = HousingDescription {
        parts: vec![HousingPart { group: "box".to_owned(), material: aluminium.into() }],
        supports: vec![base],
        ..HousingDescription::default()
    };
    HousingModel::new(mesh, description).expect("a valid model")
}

fn megabytes(matrix: &SparseMatrix) -> f64 {
    let words = matrix.indptr().raw_storage().len() + matrix.indices().len() + matrix.nnz();
    8e-6 * words as f64
}

fn main() {
    let asked = std::env::var("ASSEMBLY_DOF").ok().and_then(|text| text.parse().ok());
    let nodes = asked.unwrap_or(250_000.0) / 3.0;
    let cells = ((f64::cbrt(nodes) - 1.0) / 2.0).round().max(1.0) as usize;
    let mesh = tet_box(cells);
    let model = model(&mesh);
    drop(mesh);
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage_as_mb();
    let started = Instant::now();
    let matrices = SystemMatrices::assemble(&model).expect("valid elements");
    let assembly_s = started.elapsed().as_secs_f64();
    let peak = f64::from(MEMORY.peak_usage_as_mb() - before) * 1.048_576;
    let size = megabytes(&matrices.stiffness) + megabytes(&matrices.mass);
    println!("{} degrees of freedom, {} elements", model.dof(), model.elements().len());
    println!("first assembly {assembly_s:.3} s; K and M {size:.0} MB, peak {peak:.0} MB: {:.2} times", peak / size);
    if std::env::var_os("ASSEMBLY_MODES").is_some() {
        let started = Instant::now();
        let modes = housing_modes(&model, matrices, ModeRange::Count(20)).expect("converges");
        let modal_s = started.elapsed().as_secs_f64();
        println!(
            "20 modes in {modal_s:.1} s (first {:.1} Hz): assembly is {:.1} % of assembly and modes",
            modes.frequencies_hz[0],
            100.0 * assembly_s / (assembly_s + modal_s)
        );
    } else {
        drop(matrices);
    }
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    criterion.bench_function("assemble K and M", |bencher| {
        bencher.iter(|| SystemMatrices::assemble(black_box(&model)).expect("valid elements"));
    });
    criterion.final_summary();
}
