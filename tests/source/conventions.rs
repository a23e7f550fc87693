//! The protos keep to the conventions of docs/api.md.

use prost_reflect::{
    DescriptorPool, ExtensionDescriptor, FieldDescriptor, Kind, MessageDescriptor, Value,
};
use std::collections::{BTreeMap, BTreeSet};

const PACKAGE: &str = "sinew.v1";

fn pool() -> DescriptorPool {
    DescriptorPool::decode(&include_bytes!("../../src/wire/gen/descriptor.bin")[..])
        .expect("the descriptor set is part of the build")
}

/// All messages of the package.
fn messages(pool: &DescriptorPool) -> Vec<MessageDescriptor> {
    pool.all_messages()
        .filter(|m| m.package_name() == PACKAGE)
        .collect()
}

fn extension(pool: &DescriptorPool, name: &str) -> ExtensionDescriptor {
    pool.get_extension_by_name(name)
        .unwrap_or_else(|| panic!("{name} is vendored"))
}

fn name_of(field: &FieldDescriptor) -> String {
    format!("{}.{}", field.parent_message().name(), field.name())
}

/// Names in backquotes in the first column of a table of docs/api.md.
fn table(heading: &str) -> Vec<String> {
    let page = include_str!("../../docs/api.md");
    let start = page
        .find(heading)
        .unwrap_or_else(|| panic!("docs/api.md has the table {heading}"));
    let rows = page[start..]
        .lines()
        .skip(2)
        .take_while(|l| l.starts_with('|'));
    rows.flat_map(|row| {
        let cell = row.split('|').nth(1).unwrap_or_default();
        let names = cell.split('`').skip(1).step_by(2);
        names.map(str::to_owned).collect::<Vec<_>>()
    })
    .collect()
}

fn is_number(kind: &Kind) -> bool {
    match kind {
        Kind::Message(m) => matches!(m.name(), "Vector3" | "Numbers"),
        Kind::Enum(_) | Kind::Bool | Kind::String | Kind::Bytes => false,
        _ => true,
    }
}

#[test]
fn every_quantity_has_a_unit_of_the_table_or_a_reason_to_have_none() {
    let (suffixes, exempt) = (table("| suffix | unit |"), table("| field | what it is |"));
    assert!(suffixes.len() > 15 && exempt.len() > 15);
    let (mut missing, mut used) = (Vec::new(), BTreeSet::new());
    for field in messages(&pool()).iter().flat_map(|m| m.fields()) {
        if !is_number(&field.kind()) {
            continue;
        }
        let all_of = format!("{}.*", field.parent_message().name());
        let names = [name_of(&field), field.name().to_owned(), all_of];
        // The longest ending decides: `_rad_s` does not count as `_s`.
        let suffix = suffixes
            .iter()
            .filter(|s| field.name().ends_with(s.as_str()))
            .max_by_key(|s| s.len());
        match names.iter().find(|n| exempt.contains(n)).or(suffix) {
            Some(rule) => {
                used.insert(rule.clone());
            }
            None => missing.push(name_of(&field)),
        }
    }
    assert!(missing.is_empty(), "without a unit: {missing:?}");
    let stale: Vec<_> = suffixes
        .iter()
        .chain(&exempt)
        .filter(|r| !used.contains(*r))
        .collect();
    assert!(
        stale.is_empty(),
        "docs/api.md names what there is not: {stale:?}"
    );
}

#[test]
fn no_number_is_unsigned() {
    for field in messages(&pool()).iter().flat_map(|m| m.fields()) {
        let unsigned = matches!(
            field.kind(),
            Kind::Uint32 | Kind::Uint64 | Kind::Fixed32 | Kind::Fixed64
        );
        assert!(!unsigned, "{} is unsigned", name_of(&field));
    }
}

/// Values of the behaviour of a field.
fn behaviours(field: &FieldDescriptor, extension: &ExtensionDescriptor) -> Vec<String> {
    let Kind::Enum(names) = extension.kind() else {
        panic!("a behaviour is an enumeration");
    };
    let options = field.options();
    let value = options.get_extension(extension);
    let list = value.as_list().expect("it is repeated");
    list.iter()
        .filter_map(Value::as_enum_number)
        .filter_map(|n| names.get_value(n).map(|v| v.name().to_owned()))
        .collect()
}

#[test]
fn every_field_of_a_request_says_how_it_behaves() {
    let pool = pool();
    let behaviour = extension(&pool, "google.api.field_behavior");
    for method in pool
        .services()
        .flat_map(|s| s.methods().collect::<Vec<_>>())
    {
        for field in method.input().fields() {
            let of_choice = field.containing_oneof().is_some_and(|o| !o.is_synthetic());
            let said = behaviours(&field, &behaviour);
            assert!(
                of_choice == said.is_empty(),
                "{}: {said:?}",
                name_of(&field)
            );
            let required = said.iter().any(|b| b == "REQUIRED");
            let optional = said.iter().any(|b| b == "OPTIONAL");
            assert!(
                of_choice || required != optional,
                "{}: {said:?}",
                name_of(&field)
            );
            let whose = matches!(field.name(), "name" | "parent");
            assert!(!whose || required, "{} is required", name_of(&field));
        }
    }
}

/// The type of the resources that a field names, if it is declared.
fn reference(field: &FieldDescriptor, extension: &ExtensionDescriptor) -> Option<String> {
    let options = field.options();
    if !options.has_extension(extension) {
        return None;
    }
    let value = options.get_extension(extension);
    let message = value.as_message().expect("a reference is a message");
    ["type", "child_type"].iter().find_map(|part| {
        let value = message.get_field_by_name(part)?;
        value.as_str().filter(|t| !t.is_empty()).map(str::to_owned)
    })
}

#[test]
fn names_are_resource_names_and_say_of_what() {
    let pool = pool();
    let resource = extension(&pool, "google.api.resource");
    let refers = extension(&pool, "google.api.resource_reference");
    let mut kinds = BTreeMap::new();
    for message in messages(&pool) {
        if message.options().has_extension(&resource) {
            let options = message.options();
            let value = options.get_extension(&resource);
            let value = value.as_message().expect("a resource is a message");
            let part = |name: &str| value.get_field_by_name(name).map(|v| v.into_owned());
            let kind = part("type").and_then(|v| v.as_str().map(str::to_owned));
            assert_eq!(kind, Some(format!("sinew/{}", message.name())));
            assert!(message.get_field_by_name("name").is_some(), "{message:?}");
            kinds.insert(message.name().to_lowercase(), message.name().to_owned());
        }
    }
    let expected = [
        "body",
        "checkpoint",
        "clip",
        "figure",
        "grant",
        "obstacle",
        "operation",
        "world",
    ];
    for kind in expected {
        assert!(kinds.contains_key(kind), "{kind} is a resource");
    }
    for message in messages(&pool) {
        let is_resource = kinds.values().any(|k| k == message.name());
        for field in message.fields() {
            if field.kind() != Kind::String {
                continue;
            }
            let (name, said) = (field.name(), reference(&field, &refers));
            if let Some(kind) = &said {
                let kind = kind.strip_prefix("sinew/").expect("our own resources");
                assert!(kinds.values().any(|k| k == kind), "{}", name_of(&field));
                assert!(
                    !name.ends_with("_id"),
                    "{} is a whole name",
                    name_of(&field)
                );
            }
            let names_one = kinds.contains_key(name) || name == "parent";
            let of_request = name == "name" && message.name().ends_with("Request");
            assert!(
                !(names_one || of_request) || is_resource && name == "name" || said.is_some(),
                "{} does not say of what it is the name",
                name_of(&field)
            );
        }
    }
}

#[test]
fn standard_methods_have_the_fields_of_their_kind() {
    let pool = pool();
    let has = |m: &MessageDescriptor, name: &str| m.get_field_by_name(name).is_some();
    for method in pool
        .services()
        .flat_map(|s| s.methods().collect::<Vec<_>>())
    {
        let (name, input, output) = (method.name().to_owned(), method.input(), method.output());
        if input.package_name() != PACKAGE {
            continue;
        }
        assert_eq!(input.name(), format!("{name}Request"));
        assert_eq!(output.name(), format!("{name}Response"));
        let needs: &[&str] = match () {
            () if name.starts_with("List") => &["page_size", "page_token"],
            () if name.starts_with("Create") => &["request_id", "validate_only"],
            () if name.starts_with("Update") => &["update_mask", "validate_only"],
            () if name == "DeleteOperation" => &["name"], // a deleted one is already gone
            () if name.starts_with("Delete") => &["name", "request_id"],
            () => &[],
        };
        for field in needs {
            assert!(has(&input, field), "{name} takes {field}");
        }
        if name.starts_with("List") {
            assert!(has(&output, "next_page_token"), "{name} gives pages");
        }
        if name.starts_with("Update") {
            let resource = name.trim_start_matches("Update").to_lowercase();
            let resource = input.get_field_by_name(&resource).expect("the resource");
            let Kind::Message(resource) = resource.kind() else {
                panic!("{name} takes a resource");
            };
            assert!(has(&resource, "etag"), "{name} checks the etag");
            let delete = format!("{PACKAGE}.{}Request", name.replace("Update", "Delete"));
            let delete = pool
                .get_message_by_name(&delete)
                .expect("it can be deleted");
            assert!(has(&delete, "etag"), "{} checks it, too", delete.name());
        }
    }
}
