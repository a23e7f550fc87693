//! Permissions: identities, roles, leases and quotas, tested by a real client against the server in this process.

#[allow(dead_code)] // not every function
mod entering;
mod identity;
mod leases;
mod roles;
mod support;
mod tenants;
