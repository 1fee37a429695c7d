//! Bytes of an array to numbers and text.

use super::super::bytes::{ByteOrder, NumberType};

/// Reads a value from its bytes.
type Decode<T> = dyn Fn(&[u8]) -> T;

/// How one value is read.
pub(super) struct Decoder<T> {
    /// Bytes a value, at least 1.
    pub(super) bytes: usize,
    /// Reads one from that many bytes.
    pub(super) decode: Box<Decode<T>>,
}

/// Most characters a text that are believed.
const LONGEST_TEXT: usize = 1 << 14;

/// Byte order and name of NumPy's type.
fn order(type_name: &str) -> Option<(ByteOrder, &str)> {
    let order = if type_name.starts_with('>') { ByteOrder::Big } else { ByteOrder::Little };
    let name = type_name.strip_prefix(['<', '>']);
    // a single byte has no order
    let single = || type_name.strip_prefix('|').filter(|name| name.ends_with('1'));
    Some((order, name.or_else(single)?))
}

/// Real numbers: f8, f4, and whole ones of one to eight bytes.
pub(super) fn real(type_name: &str) -> Option<Decoder<f64>> {
    let (order, name) = order(type_name)?;
    let number = match name {
        "f8" => NumberType::F64,
        "f4" => NumberType::F32,
        "i8" => NumberType::I64,
        "i4" => NumberType::I32,
        "i2" => NumberType::I16,
        "i1" => NumberType::I8,
        "u4" => NumberType::U32,
        "u2" => NumberType::U16,
        "u1" => NumberType::U8,
        _ => return None,
    };
    Some(Decoder { bytes: number.width(), decode: Box::new(move |bytes| number.value(bytes, order)) })
}

/// Whole numbers: i8, i4, u4.
pub(super) fn whole(type_name: &str) -> Option<Decoder<i64>> {
    let (order, name) = order(type_name)?;
    let (bytes, decode): (_, Box<Decode<i64>>) = match name {
        "i8" => (8, Box::new(move |bytes| i64::from_le_bytes(order.lowest_first(bytes)))),
        "i4" => (4, Box::new(move |bytes| i64::from(i32::from_le_bytes(order.lowest_first(bytes))))),
        "u4" => (4, Box::new(move |bytes| i64::from(order.u32(bytes)))),
        _ => return None,
    };
    Some(Decoder { bytes, decode })
}

/// Text: U (four bytes a character) and S (one), padded with zeros.
pub(super) fn text(type_name: &str) -> Option<Decoder<String>> {
    let length = |digits: &str| digits.parse().ok().filter(|length: &usize| (1..=LONGEST_TEXT).contains(length));
    if let Some(digits) = type_name.strip_prefix("|S") {
        let decode = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_end_matches('\0').to_owned();
        return Some(Decoder { bytes: length(digits)?, decode: Box::new(decode) });
    }
    let (order, name) = order(type_name)?;
    let decode = move |bytes: &[u8]| {
        let codes = bytes.chunks_exact(4).map(|code| order.u32(code));
        let padded: String = codes.map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        padded.trim_end_matches('\0').to_owned()
    };
    Some(Decoder { bytes: 4 * length(name.strip_prefix('U')?)?, decode: Box::new(decode) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::float_cmp)] // numbers that both types hold
    fn numbers_of_every_width_and_order() {
        let read = |name: &str, bytes: &[u8]| real(name).map(|own| (own.decode)(bytes));
        assert_eq!(read("<f8", &1.25_f64.to_le_bytes()), Some(1.25));
        assert_eq!(read(">f8", &1.25_f64.to_be_bytes()), Some(1.25));
        assert_eq!(read("<f4", &(-2.5_f32).to_le_bytes()), Some(-2.5));
        assert_eq!(read(">i4", &(-7_i32).to_be_bytes()), Some(-7.0));
        assert_eq!(read("<i8", &9_i64.to_le_bytes()), Some(9.0));
        assert_eq!(read("<i2", &(-300_i16).to_le_bytes()), Some(-300.0));
        assert_eq!(read(">u2", &60_000_u16.to_be_bytes()), Some(60_000.0));
        assert_eq!(read("<u4", &u32::MAX.to_le_bytes()), Some(4_294_967_295.0));
        assert_eq!(read("|i1", &[0x80]), Some(-128.0));
        assert_eq!(read("|u1", &[0x80]), Some(128.0));
        for other in ["<c16", "f8", "|O", "|b1", "|S1", "|i2", "<f2", "<u8", ""] {
            assert_eq!(read(other, &[0; 16]), None, "{other}");
        }
        let read = |name: &str, bytes: &[u8]| whole(name).map(|own| (own.decode)(bytes));
        assert_eq!(read(">i8", &(-3_i64).to_be_bytes()), Some(-3));
        assert_eq!(read("<i4", &(-3_i32).to_le_bytes()), Some(-3));
        assert_eq!(read("<u4", &u32::MAX.to_le_bytes()), Some(4_294_967_295));
        assert_eq!(read("<f8", &[0; 8]), None);
    }

    #[test]
    fn text_loses_its_padding() {
        let read = |name: &str, bytes: &[u8]| text(name).map(|own| (own.decode)(bytes));
        let codes = ['b', 'ä', '\0'].map(u32::from);
        let little: Vec<u8> = codes.iter().flat_map(|code| code.to_le_bytes()).collect();
        let big: Vec<u8> = codes.iter().flat_map(|code| code.to_be_bytes()).collect();
        assert_eq!(read("<U3", &little).as_deref(), Some("bä"));
        assert_eq!(read(">U3", &big).as_deref(), Some("bä"));
        assert_eq!(read("|S3", b"ab\0").as_deref(), Some("ab"));
        assert_eq!(read("|S2", &[0, 0]).as_deref(), Some(""));
        assert_eq!(read("<U1", &[0xff; 4]).as_deref(), Some("\u{fffd}"));
        for other in ["<U0", "|S0", "<U16385", "<f8", "U3"] {
            assert_eq!(read(other, &[]), None, "{other}");
        }
    }
}
