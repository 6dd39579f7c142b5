//! A grey image in memory.

/// Grey values, row by row from the top; 0 is black, 255 white, whatever the file's depth was.
#[derive(Debug, Clone, PartialEq)]
pub struct GrayImage {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl GrayImage {
    /// From rows of grey values; `None` unless there are exactly `width * height` of them.
    pub fn new(width: usize, height: usize, values: Vec<f32>) -> Option<Self> {
        (width.checked_mul(height) == Some(values.len())).then_some(Self { width, height, values })
    }
    /// Pixels per row.
    pub fn width(&self) -> usize {
        self.width
    }
    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }
    /// All grey values, row by row.
    pub fn values(&self) -> &[f32] {
        &self.values
    }
    /// Grey value of pixel `(x, y)`.
    pub fn at(&self, x: usize, y: usize) -> f32 {
        self.values[y * self.width + x]
    }
    /// Rounded to 8 bits.
    pub fn to_u8(&self) -> Vec<u8> {
        self.values.iter().map(|v| v.round().clamp(0.0, 255.0) as u8).collect()
    }
}
