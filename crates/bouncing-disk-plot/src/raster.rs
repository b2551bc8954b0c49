//! A picture of cells, such as basins of attraction.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::png_image;
use crate::svg::Svg;

/// Cells of equal size, each with a colour of a palette, embedded as one PNG.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    width: usize,
    height: usize,
    cells: Vec<u8>,
    palette: Vec<(Colour, u8)>,
    x: (f64, f64),
    y: (f64, f64),
}

impl Raster {
    /// `width` times `height` cells over the data rectangle `x` by `y` (outer edges of the outermost cells).
    ///
    /// `cells` are indices into `palette`, row by row; the first row lies at `y.0`, the first cell of a row at
    /// `x.0`.
    pub fn new(
        width: usize,
        height: usize,
        cells: Vec<u8>,
        palette: &[Colour],
        x: (f64, f64),
        y: (f64, f64),
    ) -> Self {
        let palette = palette.iter().map(|colour| (*colour, 255)).collect();
        Self { width, height, cells, palette, x, y }
    }

    /// Makes one colour of the palette transparent.
    #[must_use]
    pub fn transparent(mut self, index: u8) -> Self {
        if let Some(colour) = self.palette.get_mut(usize::from(index)) {
            colour.1 = 0;
        }
        self
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let (width, height) = (self.width, self.height);
        if width.checked_mul(height) != Some(self.cells.len()) || self.cells.is_empty() {
            return Err(DrawError::RasterSize { width, height, cells: self.cells.len() });
        }
        let colours = self.palette.len();
        if let Some(index) = self.cells.iter().copied().find(|index| usize::from(*index) >= colours) {
            return Err(DrawError::RasterColour { index, colours });
        }
        let (from, to) = (frame.point((self.x.0, self.y.0)), frame.point((self.x.1, self.y.1)));
        // Image rows run downwards on the page: the first row of data is the last of the image, unless the
        // axis runs backwards; likewise for columns.
        let (flip_columns, flip_rows) = (to.x < from.x, to.y < from.y);
        let mut pixels = Vec::with_capacity(self.cells.len());
        for row in 0..height {
            let row = if flip_rows { height - 1 - row } else { row };
            let cells = &self.cells[row * width..(row + 1) * width];
            if flip_columns { pixels.extend(cells.iter().rev()) } else { pixels.extend(cells) }
        }
        let area = kurbo::Rect::from_points(from, to);
        if !(area.is_finite() && area.area() > 0.0) {
            return Err(DrawError::Size { what: "a raster", width: area.width(), height: area.height() });
        }
        let png = png_image::indexed(width, height, &pixels, &self.palette)?;
        svg.image(area, &png, true);
        Ok(())
    }
}
