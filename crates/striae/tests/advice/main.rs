//! Advice on decks with physical mistakes, and none on published cases.

mod mistakes;
mod published;
