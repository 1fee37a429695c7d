//! Kinds of numbers in an archive.

/// A number that an array may hold.
pub trait NpzElement: Copy + sealed::Sealed {
    /// NumPy's name of the type.
    const TYPE: &'static str;
    /// Bytes a number.
    const BYTES: usize;

    /// Appends the number, little-endian.
    fn extend_bytes(self, bytes: &mut Vec<u8>);
}

mod sealed {
    /// No other types: their names and bytes belong together.
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for i32 {}
    impl Sealed for i64 {}
}

macro_rules! element {
    ($number:ty, $name:literal) => {
        impl NpzElement for $number {
            const TYPE: &'static str = $name;
            const BYTES: usize = size_of::<$number>();

            fn extend_bytes(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
        }
    };
}

element!(f64, "<f8");
element!(i32, "<i4");
element!(i64, "<i8");
