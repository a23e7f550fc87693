//! Protobuf messages and domain types, and the conversion between them.
//!
//! [`pb`] is generated and checked in (`tests/source/proto_bootstrap.rs`). Only [`convert`] and [`frame`] read or fill
//! its fields; beyond them everything is a domain type of [`types`] or of [`sinew_physics`]. [`status`] turns faults
//! into gRPC statuses; [`scan`] checks the bytes of a request before [`codec`] decodes them.

/// Messages, clients and servers of package `sinew.v1`, generated.
#[allow(
    missing_docs,
    clippy::all,
    clippy::pedantic,
    clippy::unwrap_used,
    rustdoc::all,
    rust_2018_idioms
)]
pub mod pb {
    include!("gen/sinew.v1.rs");
}

pub mod codec;
pub mod convert;
pub mod frame;
pub mod posture;
pub mod repeatable;
pub mod scan;
pub mod status;
pub mod types;
pub mod watched;

/// The descriptor set of all protos, for reflection and for clients that work from descriptors.
pub const DESCRIPTOR_SET: &[u8] = include_bytes!("gen/descriptor.bin");
