//! Resource names: one style, one parser.
//!
//! A name is a sequence of collections and ids: `worlds/{world}/figures/{figure}`. Fields named after a resource hold
//! such names, fields that end in `_id` the last part of one.

use super::super::status::Fault;
use super::shortened;

/// The form of the names of one kind of resource: collections, each with the meaning of its ids.
#[derive(Clone, Copy, Debug)]
pub struct Form<const N: usize>([(&'static str, &'static str); N]);

/// `worlds/{world}`.
pub const WORLD: Form<1> = Form([("worlds", "world")]);
/// `worlds/{world}/figures/{figure}`.
pub const FIGURE: Form<2> = Form([("worlds", "world"), ("figures", "figure")]);
/// `worlds/{world}/obstacles/{obstacle}`.
pub const OBSTACLE: Form<2> = Form([("worlds", "world"), ("obstacles", "obstacle")]);
/// `worlds/{world}/grants/{grant}`.
pub const GRANT: Form<2> = Form([("worlds", "world"), ("grants", "grant")]);
/// `worlds/{world}/checkpoints/{checkpoint}`.
pub const CHECKPOINT: Form<2> = Form([("worlds", "world"), ("checkpoints", "checkpoint")]);
/// `worlds/{world}/recordings/{recording}`.
pub const RECORDING: Form<2> = Form([("worlds", "world"), ("recordings", "recording")]);
/// `clips/{clip}`.
pub const CLIP: Form<1> = Form([("clips", "clip")]);
/// `bodies/{body}`.
pub const BODY: Form<1> = Form([("bodies", "body")]);
/// `operations/{operation}`.
pub const OPERATION: Form<1> = Form([("operations", "operation")]);

impl<const N: usize> Form<N> {
    /// The ids of a name.
    ///
    /// # Errors
    /// It has another form.
    pub fn ids<'a>(&self, field: &str, name: &'a str) -> Result<[&'a str; N], Fault> {
        let mut ids = [""; N];
        let mut parts = name.splitn(2 * N + 1, '/');
        for ((collection, _), id) in self.0.iter().zip(&mut ids) {
            let named = parts.next() == Some(collection);
            match parts.next() {
                Some(part) if named && !part.is_empty() => *id = part,
                _ => return Err(self.refused(field, name)),
            }
        }
        match parts.next() {
            None => Ok(ids),
            Some(_) => Err(self.refused(field, name)),
        }
    }

    /// The name of these ids.
    pub fn name(&self, ids: [&str; N]) -> String {
        let parts = self.0.iter().zip(ids);
        let parts: Vec<_> = parts.map(|((c, _), id)| format!("{c}/{id}")).collect();
        parts.join("/")
    }

    /// The form as it is written in documents.
    pub fn pattern(&self) -> String {
        let parts = self.0.iter().map(|(c, id)| format!("{c}/{{{id}}}"));
        parts.collect::<Vec<_>>().join("/")
    }

    fn refused(&self, field: &str, name: &str) -> Fault {
        Fault::invalid(
            field,
            format!(
                "must be a resource name {}, got {:?}",
                self.pattern(),
                shortened(name)
            ),
        )
    }
}

/// Last part of `worlds/{world}`.
///
/// # Errors
/// It is not such a name.
pub fn world_name<'a>(field: &str, name: &'a str) -> Result<&'a str, Fault> {
    WORLD.ids(field, name).map(|[world]| world)
}

/// Last part of `clips/{clip}`.
///
/// # Errors
/// It is not such a name.
pub fn clip_name<'a>(field: &str, name: &'a str) -> Result<&'a str, Fault> {
    CLIP.ids(field, name).map(|[clip]| clip)
}

/// World and figure of `worlds/{world}/figures/{figure}`.
///
/// # Errors
/// It is not such a name.
pub fn figure_name<'a>(field: &str, name: &'a str) -> Result<(&'a str, &'a str), Fault> {
    FIGURE.ids(field, name).map(|[world, id]| (world, id))
}

/// World and obstacle of `worlds/{world}/obstacles/{obstacle}`.
///
/// # Errors
/// It is not such a name.
pub fn obstacle_name<'a>(field: &str, name: &'a str) -> Result<(&'a str, &'a str), Fault> {
    OBSTACLE.ids(field, name).map(|[world, id]| (world, id))
}

/// World and grant of `worlds/{world}/grants/{grant}`.
///
/// # Errors
/// It is not such a name.
pub fn grant_name<'a>(field: &str, name: &'a str) -> Result<(&'a str, &'a str), Fault> {
    GRANT.ids(field, name).map(|[world, id]| (world, id))
}

/// World and checkpoint of `worlds/{world}/checkpoints/{checkpoint}`.
///
/// # Errors
/// It is not such a name.
pub fn checkpoint_name<'a>(field: &str, name: &'a str) -> Result<(&'a str, &'a str), Fault> {
    CHECKPOINT.ids(field, name).map(|[world, id]| (world, id))
}

/// Last part of `operations/{operation}`.
///
/// # Errors
/// It is not such a name.
pub fn operation_name<'a>(field: &str, name: &'a str) -> Result<&'a str, Fault> {
    OPERATION.ids(field, name).map(|[operation]| operation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_taken_apart_or_refused() {
        assert_eq!(world_name("name", "worlds/a").unwrap(), "a");
        assert_eq!(
            figure_name("name", "worlds/a/figures/b").unwrap(),
            ("a", "b")
        );
        let bad = [
            "",
            "/",
            "worlds/",
            "worlds",
            "world/a",
            "worlds/a/b",
            "worlds/a/",
            "/worlds/a",
        ];
        for bad in bad {
            let fault = world_name("parent", bad).unwrap_err();
            let Fault::Invalid { field, problem } = fault else {
                panic!("{bad}: {fault}");
            };
            assert_eq!(field, "parent", "{bad}");
            assert!(problem.contains("worlds/{world}"), "{problem}");
        }
        let bad = [
            "worlds/a/figures",
            "worlds/a/figures/",
            "worlds//figures/b",
            "worlds/a/obstacles/b",
            "worlds/a/figures/b/c",
            "worlds/a/figures/b/",
            "worlds/a",
        ];
        for bad in bad {
            assert!(figure_name("name", bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn names_come_back_as_they_were_put_together() {
        let name = CHECKPOINT.name(["w", "c"]);
        assert_eq!(name, "worlds/w/checkpoints/c");
        assert_eq!(checkpoint_name("name", &name).unwrap(), ("w", "c"));
        assert_eq!(OBSTACLE.pattern(), "worlds/{world}/obstacles/{obstacle}");
    }
}
