//! Import of a large mesh against the parse of mshio alone: a box of Tet10 in two physical groups,
//! written by this program. Both read the file from the disk (from its cache, after the first time).
//!
//! `IMPORT_MB` sets the size of the ASCII 4.1 file, 150 if absent: `IMPORT_MB=20 cargo bench --bench import`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use criterion::{Criterion, Throughput};
use plummer::fe::mesh::Mesh;
use plummer::numerics::units::LengthUnit;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Cells of the box in one direction; each is 27 nodes (shared) and six tetrahedra on its main diagonal.
struct TetBox {
    cells: usize,
}

impl TetBox {
    /// ASCII 4.1 takes about this many bytes a cell.
    const CELL_BYTES: f64 = 895.0;

    fn of_megabytes(megabytes: f64) -> Self {
        let cells = (megabytes * 1e6 / Self::CELL_BYTES).cbrt();
        Self { cells: (cells as usize).max(1) }
    }

    fn side(&self) -> usize {
        2 * self.cells + 1
    }

    fn nodes(&self) -> impl Iterator<Item = [f64; 3]> {
        let side = self.side();
        let at = |i: usize| i as f64 * 0.1 / 3.0;
        (0..side.pow(3)).map(move |i| [at(i % side), at(i / side % side), at(i / side / side)])
    }

    /// Node tags of each element.
    fn elements(&self) -> impl Iterator<Item = [u64; 10]> {
        const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [3, 0], [3, 2], [3, 1]];
        let (n, side) = (self.cells, self.side());
        let tag = move |p: [usize; 3]| (1 + p[0] + side * (p[1] + side * p[2])) as u64;
        (0..n.pow(3)).flat_map(move |cell| {
            let origin = [cell % n, cell / n % n, cell / n / n].map(|i| 2 * i);
            PATHS.into_iter().map(move |path| {
                let mut corners = [origin; 4];
                for (step, axis) in path.into_iter().enumerate() {
                    corners[step + 1..].iter_mut().for_each(|corner| corner[axis] += 2);
                }
                let mut tags = [0; 10];
                for (slot, corner) in tags.iter_mut().zip(corners) {
                    *slot = tag(corner);
                }
                for (slot, [a, b]) in tags[4..].iter_mut().zip(EDGES) {
                    *slot = tag([0, 1, 2].map(|axis| usize::midpoint(corners[a][axis], corners[b][axis])));
                }
                tags
            })
        })
    }

    fn write(&self, path: &Path, version: &str, binary: bool) -> Outcome {
        let mut out = BufWriter::new(File::create(path)?);
        write!(out, "$MeshFormat\n{version} {} 8\n", u8::from(binary))?;
        if binary {
            out.write_all(&1_i32.to_le_bytes())?;
            writeln!(out)?;
        }
        writeln!(out, "$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"box\"\n$EndPhysicalNames")?;
        match (version, binary) {
            ("4.1", false) => self.ascii_v41(&mut out)?,
            ("4.1", true) => self.binary_v41(&mut out)?,
            ("2.2", false) => self.ascii_v22(&mut out)?,
            _ => self.binary_v22(&mut out)?,
        }
        Ok(out.flush()?)
    }

    fn counts(&self) -> [u64; 2] {
        [self.side().pow(3) as u64, 6 * self.cells.pow(3) as u64]
    }

    fn ascii_v41(&self, out: &mut impl Write) -> Outcome {
        let [nodes, elements] = self.counts();
        writeln!(out, "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 2 1 2 0\n$EndEntities")?;
        writeln!(out, "$Nodes\n1 {nodes} 1 {nodes}\n3 1 0 {nodes}")?;
        (1..=nodes).try_for_each(|tag| writeln!(out, "{tag}"))?;
        for [x, y, z] in self.nodes() {
            writeln!(out, "{x} {y} {z}")?;
        }
        writeln!(out, "$EndNodes\n$Elements\n1 {elements} 1 {elements}\n3 1 11 {elements}")?;
        for (tag, element) in (1..).zip(self.elements()) {
            write!(out, "{tag} ")?;
            element.iter().try_for_each(|node| write!(out, "{node} "))?;
            writeln!(out)?;
        }
        Ok(writeln!(out, "$EndElements")?)
    }

    fn binary_v41(&self, out: &mut impl Write) -> Outcome {
        let [nodes, elements] = self.counts();
        let sizes = |out: &mut dyn Write, values: &[u64]| {
            values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
        };
        let ints = |out: &mut dyn Write, values: &[i32]| {
            values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
        };
        writeln!(out, "$Entities")?;
        sizes(out, &[0, 0, 0, 1])?;
        ints(out, &[1])?;
        [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].iter().try_for_each(|x: &f64| out.write_all(&x.to_le_bytes()))?;
        sizes(out, &[2])?;
        ints(out, &[1, 2])?;
        sizes(out, &[0])?;
        write!(out, "\n$EndEntities\n$Nodes\n")?;
        sizes(out, &[1, nodes, 1, nodes])?;
        ints(out, &[3, 1, 0])?;
        sizes(out, &[nodes])?;
        (1..=nodes).try_for_each(|tag| sizes(out, &[tag]))?;
        for x in self.nodes().flatten() {
            out.write_all(&x.to_le_bytes())?;
        }
        write!(out, "\n$EndNodes\n$Elements\n")?;
        sizes(out, &[1, elements, 1, elements])?;
        ints(out, &[3, 1, 11])?;
        sizes(out, &[elements])?;
        for (tag, element) in (1..).zip(self.elements()) {
            sizes(out, &[tag])?;
            sizes(out, &element)?;
        }
        Ok(write!(out, "\n$EndElements\n")?)
    }

    /// Every element once for each of the two groups, as gmsh writes them.
    fn ascii_v22(&self, out: &mut impl Write) -> Outcome {
        let [nodes, elements] = self.counts();
        writeln!(out, "$Nodes\n{nodes}")?;
        for (tag, [x, y, z]) in (1..).zip(self.nodes()) {
            writeln!(out, "{tag} {x} {y} {z}")?;
        }
        writeln!(out, "$EndNodes\n$Elements\n{}", 2 * elements)?;
        let mut tag = 0;
        for element in self.elements() {
            for group in [1, 2] {
                tag += 1;
                write!(out, "{tag} 11 2 {group} 1")?;
                element.iter().try_for_each(|node| write!(out, " {node}"))?;
                writeln!(out)?;
            }
        }
        Ok(writeln!(out, "$EndElements")?)
    }

    /// Every element once for each of the two groups, as gmsh writes them.
    fn binary_v22(&self, out: &mut impl Write) -> Outcome {
        let [nodes, elements] = self.counts();
        writeln!(out, "$Nodes\n{nodes}")?;
        for (tag, node) in (1_i32..).zip(self.nodes()) {
            out.write_all(&tag.to_le_bytes())?;
            node.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
        }
        write!(out, "\n$EndNodes\n$Elements\n{}\n", 2 * elements)?;
        let mut tag = 0;
        for element in self.elements() {
            for group in [1, 2] {
                tag += 1;
                for value in [11, 1, 2, tag, group, 1] {
                    out.write_all(&i32::to_le_bytes(value))?;
                }
                element.iter().try_for_each(|node| out.write_all(&(*node as i32).to_le_bytes()))?;
            }
        }
        Ok(write!(out, "\n$EndElements\n")?)
    }
}

fn main() -> Outcome {
    let megabytes = std::env::var("IMPORT_MB").ok().map_or(Ok(150.0), |text| text.parse())?;
    let folder = tempfile::tempdir()?;
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    for (version, binary) in [("4.1", false), ("4.1", true), ("2.2", false), ("2.2", true)] {
        let encoding = if binary { "binary" } else { "ascii" };
        let path = folder.path().join("box.msh");
        TetBox::of_megabytes(megabytes).write(&path, version, binary)?;
        let length = std::fs::metadata(&path)?.len();
        let name = format!("{version} {encoding} {:.0} MB", length as f64 / 1e6);
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Bytes(length));
        group.bench_function("plummer", |run| {
            run.iter(|| Mesh::read_gmsh(&path, LengthUnit::Metre).map(|mesh| mesh.nodes.len()))
        });
        if version == "4.1" {
            group.bench_function("mshio", |run| {
                run.iter(|| {
                    let bytes = std::fs::read(&path)?;
                    let file = mshio::parse_msh_bytes(&bytes);
                    file.map(|file| file.total_node_count()).map_err(|_| std::io::Error::other("mshio"))
                })
            });
        }
        group.finish();
    }
    criterion.final_summary();
    Ok(())
}
