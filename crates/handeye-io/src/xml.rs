//! OpenCV FileStorage XML as a [`Tree`]: every element a map of its children, or its text.

use std::path::Path;

use roxmltree::{Document, Node};

use crate::{
    error::{Error, Place, malformed},
    tree::Tree,
};

/// The children of the document's root element.
pub(crate) fn tree(text: &str, path: &Path) -> Result<Tree, Error> {
    let document = Document::parse(text).map_err(|e| {
        let place = Place::line(path, e.pos().row as usize);
        malformed(place, format!("is not XML: {e}"), "correct the file")
    })?;
    Ok(element(&document.root_element(), 0))
}

/// Text for an element or an attribute of XML or HTML.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Deeper elements are left out: no calibration file nests so far.
const DEEPEST: usize = 64;

fn element(node: &Node, depth: usize) -> Tree {
    let children: Vec<Node> = node.children().filter(Node::is_element).collect();
    if children.is_empty() || depth == DEEPEST {
        return leaf(node.text().unwrap_or_default());
    }
    let value = |child: &Node| element(child, depth + 1);
    if children.iter().all(|c| c.has_tag_name("_")) {
        return Tree::List(children.iter().map(value).collect());
    }
    Tree::Map(children.iter().map(|c| (c.tag_name().name().to_string(), value(c))).collect())
}

/// One number, a list of numbers, or text.
fn leaf(text: &str) -> Tree {
    let words: Vec<&str> = text.split_whitespace().collect();
    let numbers: Option<Vec<f64>> = words.iter().map(|w| w.parse().ok()).collect();
    match numbers.as_deref() {
        Some([]) => Tree::Null,
        Some([one]) => Tree::Number(*one),
        Some(many) => Tree::List(many.iter().copied().map(Tree::Number).collect()),
        None => Tree::Text(text.trim().into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_of_opencv_xml_has_data() {
        let text = "<?xml version=\"1.0\"?><opencv_storage><K type_id=\"opencv-matrix\"><rows>1</rows>\
                    <cols>2</cols><dt>d</dt><data>1. 2.</data></K></opencv_storage>";
        let tree = tree(text, Path::new("a.xml")).unwrap();
        assert_eq!(tree.get("K").unwrap().numbers(), Some(vec![1.0, 2.0]));
    }
}
