//! Advice on decks with physical mistakes, and none on published cases.

mod general;
mod mistakes;
mod published;
