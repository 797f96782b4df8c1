//! Types of numbers in VTK files, and arrays of them.

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

/// Order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Order {
    Little,
    Big,
}

/// The numbers of an array.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    Whole(Vec<i64>),
    Real(Vec<f64>),
}

impl Number {
    /// The type by its name in XML files.
    pub(super) fn of_xml(name: &str) -> Option<Self> {
        Some(match name {
            "Int8" => Self::I8,
            "UInt8" => Self::U8,
            "Int16" => Self::I16,
            "UInt16" => Self::U16,
            "Int32" => Self::I32,
            "UInt32" => Self::U32,
            "Int64" => Self::I64,
            "UInt64" => Self::U64,
            "Float32" => Self::F32,
            "Float64" => Self::F64,
            _ => return None,
        })
    }

    /// The type by its name in legacy files, where a `vtkIdType` has four bytes.
    pub(super) fn of_legacy(name: &str) -> Option<Self> {
        Some(match name.to_lowercase().as_str() {
            "char" | "signed_char" | "vtktypeint8" => Self::I8,
            "unsigned_char" | "vtktypeuint8" => Self::U8,
            "short" | "vtktypeint16" => Self::I16,
            "unsigned_short" | "vtktypeuint16" => Self::U16,
            "int" | "vtkidtype" | "vtktypeint32" => Self::I32,
            "unsigned_int" | "vtktypeuint32" => Self::U32,
            "long" | "long_long" | "vtktypeint64" => Self::I64,
            "unsigned_long" | "unsigned_long_long" | "vtktypeuint64" => Self::U64,
            "float" | "vtktypefloat32" => Self::F32,
            "double" | "vtktypefloat64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }

    /// The numbers that bytes are.
    pub(super) fn values(self, order: Order, bytes: &[u8]) -> Values {
        macro_rules! words {
            ($type:ty, $as:ty) => {{
                let words = bytes.as_chunks::<{ size_of::<$type>() }>().0.iter();
                let of = |word: &[u8; size_of::<$type>()]| match order {
                    Order::Little => <$type>::from_le_bytes(*word),
                    Order::Big => <$type>::from_be_bytes(*word),
                };
                words.map(|word| of(word) as $as).collect()
            }};
        }
        match self {
            Self::I8 => Values::Whole(words!(i8, i64)),
            Self::U8 => Values::Whole(words!(u8, i64)),
            Self::I16 => Values::Whole(words!(i16, i64)),
            Self::U16 => Values::Whole(words!(u16, i64)),
            Self::I32 => Values::Whole(words!(i32, i64)),
            Self::U32 => Values::Whole(words!(u32, i64)),
            Self::I64 => Values::Whole(words!(i64, i64)),
            Self::U64 => Values::Whole(words!(u64, i64)),
            Self::F32 => Values::Real(words!(f32, f64)),
            Self::F64 => Values::Real(words!(f64, f64)),
        }
    }

    /// The numbers in a text, or the first word that is not a number.
    pub(super) fn parsed<'a>(
        self,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<Values, &'a str> {
        if self.is_whole() {
            let numbers = words.map(|word| word.parse().map_err(|_| word));
            return numbers.collect::<Result<_, _>>().map(Values::Whole);
        }
        let numbers = words.map(|word| word.parse().map_err(|_| word));
        numbers.collect::<Result<_, _>>().map(Values::Real)
    }
}

impl Values {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Whole(numbers) => numbers.len(),
            Self::Real(numbers) => numbers.len(),
        }
    }

    /// The values as real numbers.
    pub(super) fn reals(self) -> Vec<f64> {
        match self {
            Self::Whole(numbers) => numbers.into_iter().map(|number| number as f64).collect(),
            Self::Real(numbers) => numbers,
        }
    }

    /// The values if they are integers.
    pub(super) fn whole(self) -> Option<Vec<i64>> {
        match self {
            Self::Whole(numbers) => Some(numbers),
            Self::Real(_) => None,
        }
    }
}
