//! A reader of Rust source, in the detail that imports need: words and signs, without comments, strings and tests.

/// A word, a number or a sign.
#[derive(Clone, Debug, PartialEq)]
pub enum Token {
    /// A name or keyword; a lifetime is read as a sign and a word.
    Word(String),
    /// A number.
    Number,
    /// Any other character.
    Sign(char),
}

/// Words and signs of Rust source. Comments, strings and character literals are left out.
pub fn tokens(source: &str) -> Vec<Token> {
    let c: Vec<char> = source.chars().collect();
    let mut out = Vec::new();
    let mut i = 0;
    while i < c.len() {
        let next = c.get(i + 1).copied().unwrap_or(' ');
        match c[i] {
            '/' if next == '/' => {
                while i < c.len() && c[i] != '\n' {
                    i += 1;
                }
            }
            '/' if next == '*' => {
                let mut depth = 0;
                while i < c.len() {
                    let pair = (c[i], c.get(i + 1).copied().unwrap_or(' '));
                    if pair == ('/', '*') {
                        depth += 1;
                        i += 2;
                    } else if pair == ('*', '/') {
                        depth -= 1;
                        i += 2;
                        if depth == 0 {
                            break;
                        }
                    } else {
                        i += 1;
                    }
                }
            }
            '"' => i = after_string(&c, i + 1),
            '\'' => {
                // A character literal, or a lifetime.
                if next == '\\' {
                    i += 3;
                    while i < c.len() && c[i] != '\'' {
                        i += 1;
                    }
                    i += 1;
                } else if c.get(i + 2) == Some(&'\'') {
                    i += 3;
                } else {
                    i += 1;
                }
            }
            x if x.is_alphabetic() || x == '_' => {
                let start = i;
                while i < c.len() && (c[i].is_alphanumeric() || c[i] == '_') {
                    i += 1;
                }
                let word: String = c[start..i].iter().collect();
                let hashes = c[i..].iter().take_while(|x| **x == '#').count();
                let quoted = c.get(i + hashes) == Some(&'"');
                match word.as_str() {
                    "r" | "br" | "cr" if quoted => i = after_raw_string(&c, i + hashes + 1, hashes),
                    "b" | "c" if quoted && hashes == 0 => i = after_string(&c, i + 1),
                    _ => out.push(Token::Word(word)),
                }
            }
            x if x.is_ascii_digit() => {
                while i < c.len()
                    && (c[i].is_alphanumeric()
                        || c[i] == '_'
                        || (c[i] == '.' && c.get(i + 1).is_some_and(char::is_ascii_digit)))
                {
                    i += 1;
                }
                out.push(Token::Number);
            }
            x => {
                if !x.is_whitespace() {
                    out.push(Token::Sign(x));
                }
                i += 1;
            }
        }
    }
    out
}

fn after_string(c: &[char], mut i: usize) -> usize {
    while i < c.len() && c[i] != '"' {
        i += if c[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

fn after_raw_string(c: &[char], mut i: usize, hashes: usize) -> usize {
    while i < c.len() {
        if c[i] == '"'
            && c[i + 1..]
                .iter()
                .take(hashes)
                .filter(|x| **x == '#')
                .count()
                == hashes
        {
            return i + 1 + hashes;
        }
        i += 1;
    }
    i
}

/// The word of a token, if it is one.
pub fn word(t: Option<&Token>) -> Option<&str> {
    match t {
        Some(Token::Word(w)) => Some(w),
        _ => None,
    }
}

/// Whether the token is this sign.
pub fn sign(t: Option<&Token>, c: char) -> bool {
    t == Some(&Token::Sign(c))
}

/// Index just after the bracket that closes the one at `open`.
pub fn after_block(t: &[Token], open: usize) -> usize {
    let mut depth = 0usize;
    for (k, token) in t.iter().enumerate().skip(open) {
        match token {
            Token::Sign('{' | '[' | '(') => depth += 1,
            Token::Sign('}' | ']' | ')') => {
                depth -= 1;
                if depth == 0 {
                    return k + 1;
                }
            }
            _ => {}
        }
    }
    t.len()
}

/// The same tokens without items marked `#[cfg(test)]`.
pub fn without_tests(t: &[Token]) -> Vec<Token> {
    let mut out = Vec::new();
    let mut i = 0;
    while i < t.len() {
        let is_test = sign(t.get(i), '#')
            && sign(t.get(i + 1), '[')
            && word(t.get(i + 2)) == Some("cfg")
            && sign(t.get(i + 3), '(')
            && word(t.get(i + 4)) == Some("test")
            && sign(t.get(i + 5), ')');
        if !is_test {
            out.push(t[i].clone());
            i += 1;
            continue;
        }
        i = after_block(t, i + 1);
        while sign(t.get(i), '#') {
            i = after_block(t, i + 1);
        }
        // The item ends with its block, or with a semicolon.
        while i < t.len() && !sign(t.get(i), ';') && !sign(t.get(i), '{') {
            i = if sign(t.get(i), '(') || sign(t.get(i), '[') {
                after_block(t, i)
            } else {
                i + 1
            };
        }
        i = if sign(t.get(i), '{') {
            after_block(t, i)
        } else {
            i + 1
        };
    }
    out
}
