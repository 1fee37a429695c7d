//! The small mesh in gmsh's binary encodings, written by the tests themselves.

use super::{SMALL, read};

/// How size_t, int and double are laid out in a file.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    pub(super) big_endian: bool,
    pub(super) size_bytes: usize,
}

/// What kind of number comes at each place of a section.
enum Number {
    Size,
    Int,
    Double,
}
use Number::{Double, Int, Size};

struct Writer<'a> {
    layout: Layout,
    words: std::str::SplitAsciiWhitespace<'a>,
    out: Vec<u8>,
}

impl Writer<'_> {
    /// Writes the next word as this kind of number and returns it.
    fn put(&mut self, number: Number) -> Result<i64, String> {
        let word = self.words.next().ok_or("the section is too short")?;
        let mut bytes = match number {
            Size => {
                let value: u64 = word.parse().map_err(|_| word.to_owned())?;
                value.to_le_bytes()[..self.layout.size_bytes].to_vec()
            }
            Int => word.parse::<i32>().map_err(|_| word.to_owned())?.to_le_bytes().to_vec(),
            Double => word.parse::<f64>().map_err(|_| word.to_owned())?.to_le_bytes().to_vec(),
        };
        if self.layout.big_endian {
            bytes.reverse();
        }
        self.out.append(&mut bytes);
        Ok(word.parse::<i64>().unwrap_or(0))
    }

    fn repeat(&mut self, count: i64, number: fn() -> Number) -> Result<(), String> {
        (0..count).try_for_each(|_| self.put(number()).map(|_| ()))
    }

    fn entities(&mut self) -> Result<(), String> {
        let counts = [self.put(Size)?, self.put(Size)?, self.put(Size)?, self.put(Size)?];
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                self.put(Int)?;
                self.repeat(if dimension == 0 { 3 } else { 6 }, || Double)?;
                for _ in 0..if dimension == 0 { 1 } else { 2 } {
                    let tags = self.put(Size)?;
                    self.repeat(tags, || Int)?;
                }
            }
        }
        Ok(())
    }

    fn nodes(&mut self) -> Result<(), String> {
        let blocks = self.put(Size)?;
        self.repeat(3, || Size)?;
        for _ in 0..blocks {
            self.repeat(3, || Int)?;
            let count = self.put(Size)?;
            self.repeat(count, || Size)?;
            self.repeat(3 * count, || Double)?;
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<(), String> {
        let blocks = self.put(Size)?;
        self.repeat(3, || Size)?;
        for _ in 0..blocks {
            self.repeat(2, || Int)?;
            let nodes = match self.put(Int)? {
                15 => 1,
                1 => 2,
                3 => 4,
                other => return Err(format!("element type {other}")),
            };
            let count = self.put(Size)?;
            self.repeat(count * (1 + nodes), || Size)?;
        }
        Ok(())
    }
}

fn section<'a>(text: &'a str, name: &str) -> Result<&'a str, String> {
    let (_, rest) = text.split_once(&format!("${name}\n")).ok_or("no start")?;
    let (content, _) = rest.split_once(&format!("$End{name}\n")).ok_or("no end")?;
    Ok(content)
}

/// An ASCII mesh (points, lines, quadrilaterals) in binary.
pub(super) fn binary(text: &str, layout: Layout) -> Result<Vec<u8>, String> {
    let mut out = format!("$MeshFormat\n4.1 1 {}\n", layout.size_bytes).into_bytes();
    out.extend(if layout.big_endian { [0, 0, 0, 1] } else { [1, 0, 0, 0] });
    out.extend(b"\n$EndMeshFormat\n$PhysicalNames\n");
    out.extend(section(text, "PhysicalNames")?.as_bytes());
    out.extend(b"$EndPhysicalNames\n");
    type Write = fn(&mut Writer<'_>) -> Result<(), String>;
    let sections: [(&str, Write); 3] =
        [("Entities", |w| w.entities()), ("Nodes", |w| w.nodes()), ("Elements", |w| w.elements())];
    for (name, write) in sections {
        let mut writer = Writer {
            layout,
            words: section(text, name)?.split_ascii_whitespace(),
            out: format!("${name}\n").into_bytes(),
        };
        write(&mut writer)?;
        out.extend(writer.out);
        out.extend(format!("\n$End{name}\n").as_bytes());
    }
    Ok(out)
}

#[test]
fn every_binary_layout_reads_like_ascii() -> Result<(), String> {
    let ascii = read(SMALL.as_bytes())?;
    for big_endian in [false, true] {
        for size_bytes in [4, 8] {
            let layout = Layout { big_endian, size_bytes };
            let mut read = read(&binary(SMALL, layout)?)?;
            assert!(read.format.binary);
            read.format = ascii.format;
            assert_eq!(read, ascii);
        }
    }
    Ok(())
}

#[test]
fn binary_files_name_the_byte() -> Result<(), String> {
    let layout = Layout { big_endian: false, size_bytes: 8 };
    let nan = binary(&SMALL.replace("1 1 0\n2 1 0\n$", "1 NaN 0\n2 1 0\n$"), layout)?;
    let start = nan.windows(8).position(|w| w == f64::NAN.to_le_bytes()).ok_or("no NaN")?;
    assert_eq!(
        read(&nan),
        Err(format!("$Nodes, byte {start}: node 5 has the coordinate NaN: expected a finite number"))
    );
    Ok(())
}
