//! A sheet as SVG in millimetres.

use std::fmt::Write;

use handeye::model::print::Shape;

use super::Sheet;
use crate::xml::escape;

/// The text of an SVG file.
pub fn svg(sheet: &Sheet, title: &str) -> String {
    let (w, h) = (mm(sheet.width), mm(sheet.height));
    let outlines: Vec<String> = sheet.shapes.iter().map(outline).collect();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\">\n\
         <title>{}</title>\n<rect width=\"{w}\" height=\"{h}\" fill=\"white\"/>\n\
         <path fill=\"black\" d=\"{}\"/>\n",
        escape(title),
        outlines.join("\n")
    );
    for t in &sheet.texts {
        let _ = writeln!(
            text,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" font-family=\"Helvetica, Arial, sans-serif\">{}</text>",
            mm(t.x),
            mm(t.y),
            mm(t.size),
            escape(&t.text)
        );
    }
    text + "</svg>\n"
}

fn outline(shape: &Shape) -> String {
    match *shape {
        Shape::Rectangle { x, y, width, height } => {
            format!("M{} {}h{}v{}h{}z", mm(x), mm(y), mm(width), mm(height), mm(-width))
        }
        Shape::Disc { x, y, radius } => {
            let (r, d) = (mm(radius), 2.0 * radius);
            format!(
                "M{} {}a{r} {r} 0 1 0 {} 0a{r} {r} 0 1 0 {} 0z",
                mm(x - radius),
                mm(y),
                mm(d),
                mm(-d)
            )
        }
    }
}

/// To a tenth of a micrometre, without needless zeros.
fn mm(value: f64) -> String {
    let text = format!("{:.4}", value + 0.0);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_in_millimetres() {
        let square = Shape::Rectangle { x: 10.0, y: 20.5, width: 30.0, height: 1.0 / 3.0 };
        let sheet = Sheet { width: 210.0, height: 297.0, shapes: vec![square], texts: vec![] };
        let text = svg(&sheet, "a < b");
        assert!(text.contains("width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\""));
        assert!(text.contains("M10 20.5h30v0.3333h-30z"), "{text}");
        assert!(text.contains("<title>a &lt; b</title>"));
        assert!(roxmltree::Document::parse(&text).is_ok());
    }
}
