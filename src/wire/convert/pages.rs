//! Pages of lists (AIP-158).

use super::super::status::Fault;
use xxhash_rust::xxh3::xxh3_64;

/// Items of a page if the request does not say, and the most items of one.
const SIZE: (usize, usize) = (100, 1000);
/// Most bytes of a token: a checksum and the key of the item before the page, in hexadecimal digits.
const MOST_TOKEN: usize = 2 * (8 + 512);

/// The kind of a list: a token of one list is invalid for another.
fn checksum(list: &str, key: &str) -> [u8; 8] {
    xxh3_64(format!("{list}\0{key}").as_bytes()).to_be_bytes()
}

/// The token of the page after the item with this key.
fn token(list: &str, key: &str) -> String {
    let mut bytes = checksum(list, key).to_vec();
    bytes.extend_from_slice(key.as_bytes());
    hex::encode(bytes)
}

/// The key in a token of a list.
fn key(list: &str, token: &str) -> Option<String> {
    if token.len() > MOST_TOKEN {
        return None;
    }
    let bytes = hex::decode(token).ok()?;
    let (sum, key) = bytes.split_at_checked(8)?;
    let key = std::str::from_utf8(key).ok()?;
    (*sum == checksum(list, key)).then(|| key.to_owned())
}

/// A page of a list that is sorted by key: the items after `page_token`, and the token of the next page. `list` names
/// the list: the parent and the collection.
///
/// # Errors
/// A negative size, or a token that does not belong to this list.
pub fn page<T>(
    list: &str,
    items: impl IntoIterator<Item = (String, T)>,
    page_size: i32,
    page_token: &str,
) -> Result<(Vec<T>, String), Fault> {
    let size = match usize::try_from(page_size) {
        Ok(0) => SIZE.0,
        Ok(n) => n.min(SIZE.1),
        Err(_) => {
            return Err(Fault::invalid(
                "page_size",
                format!("must not be negative, got {page_size}"),
            ));
        }
    };
    let after = match page_token {
        "" => None,
        given => Some(key(list, given).ok_or_else(|| {
            Fault::invalid(
                "page_token",
                "must be the next_page_token of the page before, of the same list",
            )
        })?),
    };
    // Items may have been added and removed since the page before.
    let mut rest = items
        .into_iter()
        .skip_while(|(k, _)| after.as_ref().is_some_and(|after| k <= after));
    let mut last = String::new();
    let mut page = Vec::new();
    for (key, item) in rest.by_ref().take(size) {
        last = key;
        page.push(item);
    }
    let next = if rest.next().is_some() {
        token(list, &last)
    } else {
        String::new()
    };
    Ok((page, next))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(n: usize) -> Vec<(String, usize)> {
        (0..n).map(|i| (format!("k{i:04}"), i)).collect()
    }

    #[test]
    fn pages_continue_where_the_last_one_ended() {
        let (first, token) = page("worlds", items(5), 2, "").unwrap();
        assert_eq!(first, [0, 1]);
        // Earlier items may be gone by now; the remaining ones are still listed.
        let later = items(5).into_iter().skip(2);
        assert_eq!(page("worlds", later, 3, &token).unwrap().0, [2, 3, 4]);
        let (rest, token) = page("worlds", items(5), 3, &token).unwrap();
        assert_eq!((rest, token.as_str()), (vec![2, 3, 4], ""));
    }

    #[test]
    fn sizes_are_coerced_and_negative_ones_refused() {
        assert_eq!(page("worlds", items(2000), 0, "").unwrap().0.len(), 100);
        let (most, token) = page("worlds", items(2000), i32::MAX, "").unwrap();
        assert_eq!(most.len(), 1000);
        let (rest, token) = page("worlds", items(2000), 5000, &token).unwrap();
        assert_eq!((rest.len(), token.as_str()), (1000, ""));
        for bad in [-1, i32::MIN] {
            let refused = page("worlds", items(1), bad, "");
            assert!(matches!(refused, Err(Fault::Invalid { field, .. }) if field == "page_size"));
        }
    }

    #[test]
    fn tokens_are_opaque_and_of_one_list() {
        let (_, token) = page("worlds/a/figures", items(5), 2, "").unwrap();
        assert!(!token.contains("k0001"));
        let mut cut = token.clone();
        cut.pop();
        let longest = "0".repeat(MOST_TOKEN + 2);
        for (list, bad) in [
            ("worlds/b/figures", token.as_str()),
            ("worlds/a/figures", "k0001"),
            ("worlds/a/figures", "00"),
            ("worlds/a/figures", &cut),
            ("worlds/a/figures", &longest),
        ] {
            let refused = page(list, items(5), 2, bad);
            assert!(
                matches!(refused, Err(Fault::Invalid { field, .. }) if field == "page_token"),
                "{list} {bad}"
            );
        }
    }
}
