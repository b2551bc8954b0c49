//! A picture of cells, such as basins of attraction.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::svg::Svg;

/// Cells of equal size, each with a colour of a palette, embedded as one PNG.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    width: usize,
    height: usize,
    cells: Vec<u8>,
    palette: Vec<Colour>,
    x: (f64, f64),
    y: (f64, f64),
}

impl Raster {
    /// `width` times `height` cells over the data rectangle `x` by `y` (outer edges of the outermost cells).
    ///
    /// `cells` are indices into `palette`, row by row; the first row lies at `y.0`, the first cell of a row
    /// at `x.0`.
    pub fn new(
        width: usize,
        height: usize,
        cells: Vec<u8>,
        palette: &[Colour],
        x: (f64, f64),
        y: (f64, f64),
    ) -> Self {
        Self { width, height, cells, palette: palette.to_vec(), x, y }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let (width, height) = (self.width, self.height);
        if width.checked_mul(height) != Some(self.cells.len()) || self.cells.is_empty() {
            let needed = width.saturating_mul(height);
            return Err(DrawError::Length { what: "the cells of a raster", given: self.cells.len(), needed });
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
        let palette: Vec<_> = self.palette.iter().map(|colour| (*colour, 255)).collect();
        svg.image(area, [width, height], &pixels, &palette, true)
    }
}
