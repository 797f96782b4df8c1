//! Declarations of the deck's tables.
//!
//! One declaration makes the type a table is read into, its reader, and its
//! entry in the JSON schema and the reference, so that they cannot differ:
//!
//! - [`table!`]: keys, each `required`, `optional` or, for the keys of another
//!   declaration in the same table, `include`;
//! - [`choice!`]: the word at one key decides which table it is;
//! - [`either!`]: the keys present decide which table it is;
//! - [`words!`]: a text out of a few.

macro_rules! table {
    (@field include $type:ty) => { Option<$type> };
    (@field $need:ident $type:ty) => { Option<$crate::read::At<$type>> };
    (@read include $reader:ident $key:ident $type:ty) => { <$type as $crate::read::Part>::part($reader) };
    (@read $need:ident $reader:ident $key:ident $type:ty) => { $reader.$need::<$type>(stringify!($key)) };
    (@list include $all:ident $key:ident $type:ty, $doc:expr) => {
        $all = $crate::read::combined(&$all, &<$type as $crate::read::Part>::alternatives());
    };
    (@list required $all:ident $key:ident $type:ty, $doc:expr) => {
        table!(@push $all $key $type, $doc, $crate::form::Need::Required)
    };
    (@list optional $all:ident $key:ident $type:ty, $doc:expr) => {
        table!(@push $all $key $type, $doc, $crate::form::Need::Optional)
    };
    (@push $all:ident $key:ident $type:ty, $doc:expr, $need:expr) => {
        for one in &mut $all {
            one.keys.push($crate::read::key::<$type>(stringify!($key), $doc, $need));
        }
    };
    ($(#[doc = $doc:literal])+ $name:ident {
        $($(#[doc = $key_doc:literal])+ $need:ident $key:ident: $type:ty,)*
    }) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug)]
        pub(crate) struct $name {
            /// Location of the table.
            #[allow(dead_code)]
            pub(crate) span: $crate::faults::Span,
            $($(#[doc = $key_doc])+ pub(crate) $key: table!(@field $need $type),)*
        }

        impl $crate::read::Part for $name {
            fn part(reader: &mut $crate::read::TableReader<'_, '_, '_>) -> Option<Self> {
                Some(Self { span: reader.span(), $($key: table!(@read $need reader $key $type),)* })
            }

            #[allow(unused_mut)]
            fn alternatives() -> Vec<$crate::form::Alternative> {
                let mut all = vec![$crate::form::Alternative::new(&[$($doc),+])];
                $(table!(@list $need all $key $type, &[$($key_doc),+]);)*
                all
            }
        }

        $crate::declare::read_as_table!($name);
    };
}

macro_rules! choice {
    ($(#[doc = $doc:literal])+ $name:ident by $tag:ident { $($word:literal => $variant:ident($table:ty),)+ }) => {
        $(#[doc = $doc])+
        // Tables without keys have nothing to read; few are alive, so their size does not matter.
        #[allow(dead_code, clippy::large_enum_variant)]
        #[derive(Clone, Debug)]
        pub(crate) enum $name { $($variant($table),)+ }

        impl $crate::read::Part for $name {
            fn part(reader: &mut $crate::read::TableReader<'_, '_, '_>) -> Option<Self> {
                $crate::declare::words! {
                    /// The words to choose from.
                    Tag { $(/// One of them.
                        $variant = $word,)+ }
                }
                match reader.required::<Tag>(stringify!($tag)).map(|tag| tag.value) {
                    $(Some(Tag::$variant) => <$table as $crate::read::Part>::part(reader).map(Self::$variant),)+
                    None => {
                        reader.tolerate(&Self::alternatives());
                        None
                    }
                }
            }

            fn alternatives() -> Vec<$crate::form::Alternative> {
                let doc = $crate::form::joined(&[$($doc),+]);
                let mut all = Vec::new();
                $(for mut one in <$table as $crate::read::Part>::alternatives() {
                    let tag = $crate::form::Key {
                        name: stringify!($tag),
                        doc: doc.clone(),
                        need: $crate::form::Need::Required,
                        form: $crate::form::Form::Words(vec![($word, "")]),
                    };
                    one.keys.insert(0, tag);
                    all.push(one);
                })+
                all
            }
        }

        $crate::declare::read_as_table!($name);
    };
}

macro_rules! either {
    ($(#[doc = $doc:literal])+ $name:ident { $($variant:ident($table:ty),)+ }) => {
        $(#[doc = $doc])+
        #[allow(clippy::large_enum_variant)]
        #[derive(Clone, Debug)]
        pub(crate) enum $name { $($variant($table),)+ }

        impl $crate::read::Part for $name {
            fn part(reader: &mut $crate::read::TableReader<'_, '_, '_>) -> Option<Self> {
                let groups = [$(<$table as $crate::read::Part>::alternatives(),)+];
                let readers: [fn(&mut $crate::read::TableReader<'_, '_, '_>) -> Option<Self>; _] =
                    [$(|reader| <$table as $crate::read::Part>::part(reader).map(Self::$variant),)+];
                readers[reader.choose(&groups)?](reader)
            }

            fn alternatives() -> Vec<$crate::form::Alternative> {
                [$(<$table as $crate::read::Part>::alternatives(),)+].concat()
            }
        }

        $crate::declare::read_as_table!($name);
    };
}

macro_rules! words {
    ($(#[doc = $doc:literal])+ $name:ident { $(#[doc = $word_doc:literal] $variant:ident = $word:literal,)+ }) => {
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum $name { $(#[doc = $word_doc] $variant,)+ }

        impl $crate::read::Read for $name {
            fn read(
                value: &$crate::read::Value<'_>,
                place: &$crate::read::Place,
                faults: &mut $crate::faults::FaultList<'_>,
            ) -> Option<Self> {
                let found = $crate::value::word(value, place, faults, &[$($word),+])?;
                [$(Self::$variant),+].get(found).copied()
            }

            fn form() -> $crate::form::Form {
                $crate::form::Form::Words(vec![$(($word, $word_doc)),+])
            }
        }
    };
}

macro_rules! read_as_table {
    ($name:ident) => {
        impl $crate::read::Read for $name {
            fn read(
                value: &$crate::read::Value<'_>,
                place: &$crate::read::Place,
                faults: &mut $crate::faults::FaultList<'_>,
            ) -> Option<Self> {
                $crate::read::read_table(value, place, faults)
            }

            fn form() -> $crate::form::Form {
                $crate::form::Form::Table(<Self as $crate::read::Part>::alternatives())
            }
        }
    };
}

pub(crate) use {choice, either, read_as_table, table, words};
