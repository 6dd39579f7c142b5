//! One section of BENCHMARK.md, between its marks.

/// Replaces the section, or adds it at the end.
pub fn write(file: impl AsRef<std::path::Path>, name: &str, content: &str) {
    let (begin, end) = (format!("<!-- {name}:begin -->"), format!("<!-- {name}:end -->"));
    let text = std::fs::read_to_string(&file).unwrap_or_default();
    let section = format!("{begin}\n{}\n{end}", content.trim_end());
    let text = match (text.find(&begin), text.find(&end)) {
        (Some(b), Some(e)) => format!("{}{section}{}", &text[..b], &text[e + end.len()..]),
        _ => format!("{}\n\n{section}\n", text.trim_end()),
    };
    std::fs::write(&file, text).expect("a file that can be written");
}
