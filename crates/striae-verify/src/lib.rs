//! Checks of derivatives, rates and closed forms; used by tests only.
