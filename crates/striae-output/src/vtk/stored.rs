//! Cells and values as files have them.

/// Cells of any shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StoredCells {
    /// Corners of all cells, one after the other.
    pub corners: Vec<usize>,
    /// End of each cell in `corners`.
    pub ends: Vec<usize>,
    /// VTK's codes of the shapes.
    pub shapes: Vec<u8>,
}

impl StoredCells {
    /// Shape and corners of every cell.
    pub fn iter(&self) -> impl Iterator<Item = (u8, &[usize])> {
        let starts = std::iter::once(&0).chain(&self.ends);
        let spans = starts.zip(&self.ends).zip(&self.shapes);
        spans.map(|((start, end), shape)| (*shape, &self.corners[*start..*end]))
    }
}

/// Values of an array.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredValues {
    /// Numbers of a point: 1, 3, 6 or 9.
    pub components: usize,
    /// Numbers point by point.
    pub numbers: Vec<f64>,
}
