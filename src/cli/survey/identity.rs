//! Everything that determines a survey's result, as hashes.

use anyhow::{Context, Result};

/// A hash of bytes as sixteen digits.
pub(super) fn hash(parts: &[&[u8]]) -> String {
    let mut h = sinew_physics::math::hash::Fnv::default();
    for part in parts {
        h.u64(part.len() as u64);
        for word in part.chunks(8) {
            let mut bytes = [0; 8];
            bytes[..word.len()].copy_from_slice(word);
            h.u64(u64::from_le_bytes(bytes));
        }
    }
    format!("{:016x}", h.finish())
}

/// The build: version, and a hash of the program itself.
pub(super) fn build() -> Result<String> {
    let path = std::env::current_exe().context("cannot find this program's own file")?;
    let bytes = std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(format!("{} {}", env!("CARGO_PKG_VERSION"), hash(&[&bytes])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_tell_parts_apart() {
        assert_ne!(hash(&[b"ab", b"c"]), hash(&[b"a", b"bc"]));
        assert_ne!(hash(&[b"a\0"]), hash(&[b"a"]));
        assert_eq!(hash(&[b"abc"]), hash(&[b"abc"]));
    }
}
