//! The order of names that hold numbers.

/// Order of names in which `img_2` comes before `img_10`.
pub fn natural(a: &str, b: &str) -> std::cmp::Ordering {
    let (mut a, mut b) = (a.chars().peekable(), b.chars().peekable());
    loop {
        let order = match (a.peek(), b.peek()) {
            (None, None) => return std::cmp::Ordering::Equal,
            (None, _) => return std::cmp::Ordering::Less,
            (_, None) => return std::cmp::Ordering::Greater,
            (Some(x), Some(y)) if x.is_ascii_digit() && y.is_ascii_digit() => {
                let number = |it: &mut std::iter::Peekable<std::str::Chars>| {
                    let mut digits = String::new();
                    while let Some(c) = it.next_if(char::is_ascii_digit) {
                        digits.push(c);
                    }
                    let value = digits.trim_start_matches('0').to_owned();
                    (value.len(), value, std::cmp::Reverse(digits.len()))
                };
                number(&mut a).cmp(&number(&mut b))
            }
            (Some(_), Some(_)) => a.next().cmp(&b.next()),
        };
        if order != std::cmp::Ordering::Equal {
            return order;
        }
    }
}
