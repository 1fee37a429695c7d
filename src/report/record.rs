//! The content of a report as a file, from which its page, tables and figures are drawn again.

use std::io::{BufReader, BufWriter, Read};

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;

use super::{Report, ReportError};

/// Bytes that an unpacked record may have; more is no report but an attempt on the memory.
const LARGEST: u64 = 4 << 30;

impl Report {
    /// The content as CBOR (RFC 8949) packed by gzip (RFC 1952): every number to the bit.
    ///
    /// # Errors
    /// [`ReportError`]; nothing that depends on the machine.
    pub fn to_record(&self) -> Result<Vec<u8>, ReportError> {
        let failed = |reason: String| ReportError(format!("the report's content cannot be kept: {reason}"));
        let mut packed = GzEncoder::new(Vec::new(), Compression::default());
        ciborium::into_writer(self, BufWriter::new(&mut packed)).map_err(|error| failed(error.to_string()))?;
        packed.finish().map_err(|error| failed(error.to_string()))
    }

    /// The report whose [`to_record`](Self::to_record) this is.
    ///
    /// # Errors
    /// [`ReportError`] for bytes that are damaged, cut off, or of another version's making.
    pub(crate) fn from_record(bytes: &[u8]) -> Result<Self, ReportError> {
        let failed = |reason: String| {
            ReportError(format!("not the content of a report, or not one of this version's: {reason}"))
        };
        let mut unpacked = BufReader::new(GzDecoder::new(bytes).take(LARGEST));
        let report = ciborium::from_reader(&mut unpacked).map_err(|error| failed(error.to_string()))?;
        // the checksum stands at the end
        match unpacked.read(&mut [0]) {
            Ok(0) => Ok(report),
            Ok(_) => Err(failed("more than a report".to_owned())),
            Err(error) => Err(failed(error.to_string())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::shapes::samples::cube;
    use super::super::{Abscissa, Axis, Bars, Cell, Column, Curve, Fact, Plot, Section, Table, Verdict};
    use super::*;

    fn report() -> Report {
        // no value where nothing was measured, a number without a short decimal form, a zero with a sign
        let curve =
            Curve::new("P1", Abscissa::Points(vec![1.0, f64::MIN_POSITIVE, 3.0]), vec![f64::NAN, 0.1 + 0.2, -0.0]);
        let mut plot = Plot::new("Signal", Axis::new("t", "s"), Axis::new("a", "m/s^2"));
        plot.curves.push(curve);
        let bars = Bars::new("Mass", "mode", ["1".to_owned()], Axis::new("m", "kg"));
        let table = Table::new("Lines", [Column::text("Part")]).row([Cell::number(0.1, 3)]);
        Report::new("Dent", "plummer run a.toml", "0.1.0").headline("Kurtosis", "38", Verdict::Bad).section(
            Section::new("S")
                .facts([Fact::new("Balls", "7")])
                .plot(plot)
                .bars(bars.series("x", vec![0.5]))
                .table(table)
                .shapes(cube(3, 2)),
        )
    }

    #[test]
    fn a_report_comes_back_to_the_bit() {
        let report = report();
        let bytes = report.to_record().expect("a record");
        let back = Report::from_record(&bytes).expect("the report");
        // NaN is not equal to itself: compared by what is written of them
        assert_eq!(back.to_record().expect("a record"), bytes);
        assert_eq!(format!("{back:?}"), format!("{report:?}"));
    }

    #[test]
    fn damage_is_an_error() {
        let bytes = report().to_record().expect("a record");
        for cut in [0, 1, 10, bytes.len() / 2, bytes.len() - 1] {
            let error = Report::from_record(&bytes[..cut]).expect_err("cut off");
            assert!(error.to_string().starts_with("not the content of a report"), "{cut}: {error}");
        }
        assert!(Report::from_record(b"<!DOCTYPE html>").is_err());
        // a bit anywhere: by the packing or by the checksum
        for at in (0..bytes.len()).step_by(37) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 16;
            assert!(Report::from_record(&damaged).is_err(), "{at}");
        }
    }
}
