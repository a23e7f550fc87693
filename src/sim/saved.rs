//! Serde helpers for writing a world into a checkpoint and reading it back.
//!
//! * [`array`]: arrays of any length.
//! * [`bytes`]: bytes in one piece.
//! * [`definition`]: values that many figures share, such as bodies and clips. The written value refers to them by
//!   number; their content is written once beside it ([`collecting`], [`with_definitions`]).
//! * [`nested`]: boxes of recursive types, to a bounded depth.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Something immutable that many values share.
pub type Definition = Arc<dyn Any + Send + Sync>;

/// Definitions by number, and the number of each by its address.
#[derive(Default)]
struct Table {
    all: Vec<Definition>,
    numbers: BTreeMap<usize, u32>,
}

thread_local! {
    /// Definitions of the values that this thread is writing or reading. A thread-local, because derived code takes no
    /// further argument.
    static TABLE: RefCell<Option<Table>> = const { RefCell::new(None) };
    /// Number of boxes around the one being read.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
}

/// Restores the caller's table, even if `work` panics.
struct Before(Option<Table>);

impl Drop for Before {
    fn drop(&mut self) {
        TABLE.with(|t| *t.borrow_mut() = self.0.take());
    }
}

fn within<T>(table: Table, work: impl FnOnce() -> T) -> (T, Table) {
    let before = Before(TABLE.with(|t| t.borrow_mut().replace(table)));
    let out = work();
    let table = TABLE.with(|t| t.borrow_mut().take()).unwrap_or_default();
    drop(before);
    (out, table)
}

/// Calls `write`, and also returns the definitions to which the written values refer.
pub fn collecting<T>(write: impl FnOnce() -> T) -> (T, Vec<Definition>) {
    let (out, table) = within(Table::default(), write);
    (out, table.all)
}

/// Calls `read`, which resolves references to these definitions.
pub fn with_definitions<T>(all: Vec<Definition>, read: impl FnOnce() -> T) -> T {
    let table = Table {
        all,
        ..Table::default()
    };
    within(table, read).0
}

/// An array of any length: `#[serde(with = "crate::saved::array")]`.
pub mod array {
    use serde::de::{Error, SeqAccess, Visitor};
    use serde::ser::SerializeTuple;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::fmt;
    use std::marker::PhantomData;

    /// Writes the elements in order, without their number.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer, T: Serialize, const N: usize>(
        array: &[T; N],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let mut tuple = to.serialize_tuple(N)?;
        for x in array {
            tuple.serialize_element(x)?;
        }
        tuple.end()
    }

    struct Elements<T, const N: usize>(PhantomData<T>);

    impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Elements<T, N> {
        type Value = [T; N];

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "{N} elements")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut from: A) -> Result<[T; N], A::Error> {
            let mut all = Vec::with_capacity(N);
            while all.len() < N {
                let next = from.next_element()?;
                all.push(next.ok_or_else(|| A::Error::invalid_length(all.len(), &self))?);
            }
            all.try_into()
                .map_err(|_| A::Error::custom("an array of another length"))
        }
    }

    /// Reads the output of [`serialize`].
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
        from: D,
    ) -> Result<[T; N], D::Error> {
        from.deserialize_tuple(N, Elements(PhantomData))
    }
}

/// Bytes as they are: `#[serde(with = "crate::saved::bytes")]`.
pub mod bytes {
    use serde::de::{Error, Visitor};
    use serde::{Deserializer, Serializer};
    use std::fmt;

    /// Writes them after their number.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(bytes: &[u8], to: S) -> Result<S::Ok, S::Error> {
        to.serialize_bytes(bytes)
    }

    struct Bytes;

    impl Visitor<'_> for Bytes {
        type Value = Vec<u8>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("bytes")
        }

        fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Vec<u8>, E> {
            Ok(bytes.to_vec())
        }
    }

    /// Reads the output of [`serialize`].
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<u8>, D::Error> {
        from.deserialize_bytes(Bytes)
    }
}

/// A shared definition, referred to by number: `#[serde(with = "crate::saved::definition")]`.
pub mod definition {
    use super::{Any, Arc, Definition, TABLE};
    use serde::de::Error as _;
    use serde::ser::Error as _;
    use serde::{Deserialize, Deserializer, Serializer};

    /// Writes the number of the definition, and registers the definition if it is new.
    ///
    /// # Errors
    /// Those of the serializer; nothing collects definitions.
    pub fn serialize<S: Serializer, T: Any + Send + Sync>(
        shared: &Arc<T>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let number = TABLE.with(|t| {
            let mut t = t.borrow_mut();
            let table = t.as_mut()?;
            let next = u32::try_from(table.all.len()).ok()?;
            let at = Arc::as_ptr(shared).cast::<()>() as usize;
            let number = *table.numbers.entry(at).or_insert(next);
            if number == next {
                // Keep it alive, so that its address is not reused in the meantime.
                table.all.push(Arc::clone(shared) as Definition);
            }
            Some(number)
        });
        let number = number.ok_or_else(|| S::Error::custom("definitions are not collected"))?;
        to.serialize_u32(number)
    }

    /// The definition with that number.
    ///
    /// # Errors
    /// Those of the deserializer; there is none of that number, or it is something else.
    pub fn deserialize<'de, D: Deserializer<'de>, T: Any + Send + Sync>(
        from: D,
    ) -> Result<Arc<T>, D::Error> {
        let number = u32::deserialize(from)?;
        let found = TABLE.with(|t| {
            let t = t.borrow();
            let all = &t.as_ref()?.all;
            all.get(usize::try_from(number).ok()?).cloned()
        });
        found.and_then(|d| d.downcast().ok()).ok_or_else(|| {
            D::Error::custom(format_args!("definition {number} is not what it should be"))
        })
    }

    /// The same for an optional definition.
    pub mod option {
        use super::{Any, Arc};
        use serde::{Deserialize, Deserializer, Serialize, Serializer};

        #[derive(Serialize)]
        struct Written<'a, T: Any + Send + Sync>(
            #[serde(serialize_with = "super::serialize")] &'a Arc<T>,
        );

        #[derive(Deserialize)]
        struct Read<T: Any + Send + Sync>(#[serde(with = "super")] Arc<T>);

        /// Writes its number, if it is present.
        ///
        /// # Errors
        /// Those of the serializer; nothing collects definitions.
        pub fn serialize<S: Serializer, T: Any + Send + Sync>(
            shared: &Option<Arc<T>>,
            to: S,
        ) -> Result<S::Ok, S::Error> {
            shared.as_ref().map(Written).serialize(to)
        }

        /// The definition with that number, if there is one.
        ///
        /// # Errors
        /// Those of the deserializer; there is none of that number, or it is something else.
        pub fn deserialize<'de, D: Deserializer<'de>, T: Any + Send + Sync>(
            from: D,
        ) -> Result<Option<Arc<T>>, D::Error> {
            Ok(Option::<Read<T>>::deserialize(from)?.map(|r| r.0))
        }
    }
}

/// A box in a recursive type: `#[serde(with = "crate::saved::nested")]`.
pub mod nested {
    use super::DEPTH;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// Largest nesting of boxes. Plans are nested at most twice.
    const MOST: usize = 8;

    /// Writes the content of the box.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer, T: Serialize>(
        inner: &Option<Box<T>>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        inner.serialize(to)
    }

    /// Reads the content of the box.
    ///
    /// # Errors
    /// Those of the deserializer; too deeply nested boxes.
    pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
        from: D,
    ) -> Result<Option<Box<T>>, D::Error> {
        let depth = DEPTH.get();
        if depth >= MOST {
            return Err(D::Error::custom("nested too deeply"));
        }
        DEPTH.set(depth + 1);
        let inner = Option::deserialize(from);
        DEPTH.set(depth);
        inner
    }
}
