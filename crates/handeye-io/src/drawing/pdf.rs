//! A sheet as a PDF of one page, all of it vectors.

use handeye::model::print::Shape;
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::{Sheet, Text};

/// Points of a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// Where a cubic that follows a quarter circle has its inner points, in radii.
const QUARTER: f32 = 0.552_284_8;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const FONT: Ref = Ref::new(4);
const CONTENT: Ref = Ref::new(5);
const INFO: Ref = Ref::new(6);
const FONT_NAME: Name = Name(b"F");

/// The bytes of a PDF; viewers are asked to print it unscaled.
pub fn pdf(sheet: &Sheet, title: &str) -> Vec<u8> {
    let mut pdf = Pdf::new();
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES);
    catalog.viewer_preferences().pair(Name(b"PrintScaling"), Name(b"None"));
    catalog.finish();
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    let (width, height) = ((sheet.width * POINTS) as f32, (sheet.height * POINTS) as f32);
    page.media_box(Rect::new(0.0, 0.0, width, height)).parent(PAGES).contents(CONTENT);
    page.resources().fonts().pair(FONT_NAME, FONT);
    page.finish();
    pdf.type1_font(FONT).base_font(Name(b"Helvetica"));
    pdf.stream(CONTENT, &content(sheet, height));
    pdf.document_info(INFO).title(TextStr(title));
    pdf.finish()
}

/// Millimetres from the top left, by one transform.
fn content(sheet: &Sheet, height: f32) -> Vec<u8> {
    let mut content = Content::new();
    content.transform([POINTS as f32, 0.0, 0.0, -POINTS as f32, 0.0, height]);
    content.set_fill_gray(0.0);
    for shape in &sheet.shapes {
        outline(&mut content, shape);
    }
    content.fill_nonzero();
    for text in &sheet.texts {
        write(&mut content, text);
    }
    content.finish().to_vec()
}

fn outline(content: &mut Content, shape: &Shape) {
    match *shape {
        Shape::Rectangle { x, y, width, height } => {
            content.rect(x as f32, y as f32, width as f32, height as f32);
        }
        Shape::Disc { x, y, radius } => disc(content, x as f32, y as f32, radius as f32),
    }
}

fn disc(content: &mut Content, x: f32, y: f32, r: f32) {
    let k = QUARTER * r;
    content.move_to(x + r, y);
    content.cubic_to(x + r, y + k, x + k, y + r, x, y + r);
    content.cubic_to(x - k, y + r, x - r, y + k, x - r, y);
    content.cubic_to(x - r, y - k, x - k, y - r, x, y - r);
    content.cubic_to(x + k, y - r, x + r, y - k, x + r, y);
    content.close_path();
}

fn write(content: &mut Content, text: &Text) {
    content.begin_text();
    content.set_font(FONT_NAME, text.size as f32);
    content.set_text_matrix([1.0, 0.0, 0.0, -1.0, text.x as f32, text.y as f32]);
    content.show(Str(text.text.as_bytes()));
    content.end_text();
}
