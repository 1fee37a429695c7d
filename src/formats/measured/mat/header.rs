//! The head of a file: which version it is, and which byte comes first.

use std::path::Path;

use super::super::MeasuredError;
use crate::files::Fault;
use crate::formats::bytes::ByteOrder;

/// Bytes of the head.
pub(super) const HEAD: usize = 128;
/// What an HDF5 file begins with, here or behind a head of MATLAB.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
const HDF5_PLACES: [usize; 2] = [0, 512];

/// Byte order of a file of version 5 to 7, or why it is none.
pub(super) fn byte_order(bytes: &[u8], path: &Path) -> Result<ByteOrder, MeasuredError> {
    let version = |found: &str| {
        let (path, name) = (path.display(), path.file_stem().unwrap_or_default().to_string_lossy());
        let help = format!(
            "write it again as version 7: in MATLAB m = load('{name}.mat'); save('{name}-v7.mat', '-struct', 'm', '-v7'), \
             or in Python scipy.io.savemat('{name}-v7.mat', {{'x': x}})"
        );
        let message = format!("{path}: expected a MATLAB file of version 5 to 7, found version {found}");
        MeasuredError::refused_with(message, &help)
    };
    let hdf5 = |&place: &usize| bytes.get(place..).is_some_and(|at| at.starts_with(HDF5));
    if HDF5_PLACES.iter().any(hdf5) || bytes.starts_with(b"MATLAB 7.3") {
        return Err(version("7.3 (HDF5)"));
    }
    if is_version_4(bytes) {
        return Err(version("4"));
    }
    let (order, number) = match bytes.get(HEAD - 4..HEAD) {
        Some(&[low, high, b'I', b'M']) => (ByteOrder::Little, [high, low]),
        Some(&[high, low, b'M', b'I']) => (ByteOrder::Big, [high, low]),
        other => {
            let found = match other {
                Some(end) => format!("\"{}\"", end[2..].escape_ascii()),
                None => format!("a file of {} bytes", bytes.len()),
            };
            let fault = Fault::new("the head of a MATLAB file, which ends in IM or MI", found);
            return Err(fault.within(format!("byte {}", HEAD - 2)).of(path).into());
        }
    };
    match number {
        [1, _] => Ok(order),
        [2, _] => Err(version("7.3 (HDF5)")),
        _ => Err(version("unknown")),
    }
}

/// Whether a file begins as one of version 4: five whole numbers, of which the first has the decimal digits MOPT.
fn is_version_4(bytes: &[u8]) -> bool {
    [ByteOrder::Little, ByteOrder::Big].iter().any(|order| {
        let numbers: Vec<u32> = bytes.chunks_exact(4).take(5).map(|n| order.u32(n)).collect();
        let &[kind, rows, columns, complex, name] = numbers.as_slice() else {
            return false;
        };
        let [m, o, p, t] = [kind / 1000, kind / 100 % 10, kind / 10 % 10, kind % 10];
        // M: byte order or kind of machine, P: type of the numbers, T: full, text or sparse
        m <= 4
            && o == 0
            && p <= 5
            && t <= 2
            && rows <= i32::MAX as u32
            && columns <= i32::MAX as u32
            && complex <= 1
            && (1..=256).contains(&name)
    })
}
