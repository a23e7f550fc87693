//! The cases of the load test against the protos.

use crate::operations::support::text;
use prost_reflect::DescriptorPool;
use std::collections::BTreeSet;

/// Every unary call has a case, streams have one if ghz can send them, and every case belongs to an existing call.
#[test]
fn every_unary_call_has_a_load_case() {
    let cases: Vec<serde_json::Value> =
        serde_json::from_str(&text("tests/load/cases.json")).unwrap();
    let named: BTreeSet<String> = cases
        .iter()
        .filter_map(|case| Some(case.get("call")?.as_str()?.to_owned()))
        .collect();
    let pool = DescriptorPool::decode(sinew_wire::DESCRIPTOR_SET).unwrap();
    let mut calls = BTreeSet::new();
    let mut missing = Vec::new();
    for service in pool.services() {
        for method in service.methods() {
            let call = format!("{}/{}", service.name(), method.name());
            let unary = !method.is_client_streaming() && !method.is_server_streaming();
            if unary && !named.contains(&call) {
                missing.push(call.clone());
            }
            calls.insert(call);
        }
    }
    assert!(
        missing.is_empty(),
        "no case in tests/load/cases.json: {missing:?}"
    );
    let unknown: Vec<_> = named.difference(&calls).collect();
    assert!(
        unknown.is_empty(),
        "cases of calls that there are not: {unknown:?}"
    );
    for case in &cases {
        let known = [
            "call",
            "first",
            "total",
            "at_a_time",
            "data",
            "keep",
            "rps",
            "messages",
        ];
        let keys = case.as_object().unwrap().keys();
        let odd: Vec<_> = keys.filter(|k| !known.contains(&k.as_str())).collect();
        assert!(odd.is_empty(), "{odd:?}");
    }
}
