//! `AccessService`.

use super::{Api, answer, caller};
use crate::access::grants::{Grant, GrantUpdate};
use crate::access::roles::Role;
use sinew_wire::convert::names::GRANT;
use sinew_wire::convert::{access, etags, new_id, page, timestamp, world_name};
use sinew_wire::pb::{self, access_service_server::AccessService};
use sinew_wire::status::Fault;
use std::time::SystemTime;
use tonic::{Request, Response, Status};

/// Roles of a grant, checked.
fn roles(field: &str, wire: &[i32]) -> Result<Vec<Role>, Fault> {
    let role = |(i, n): (usize, &i32)| {
        let role = pb::Role::try_from(*n).ok().and_then(Role::from_wire);
        role.filter(|r| r.is_of_world())
            .ok_or_else(|| Fault::invalid(format!("{field}[{i}]"), "must be a role in a world"))
    };
    let roles = wire.iter().take(access::MOST_ROLES).enumerate().map(role);
    let roles = roles.collect::<Result<Vec<_>, _>>()?;
    if roles.is_empty() {
        return Err(Fault::invalid(field, "must name at least one role"));
    }
    Ok(roles)
}

/// A grant on the wire.
pub fn grant_out(world: &str, g: &Grant) -> pb::Grant {
    let mut out = pb::Grant {
        name: GRANT.name([world, &g.id]),
        principal: g.principal.to_string(),
        roles: g.roles.iter().map(|r| r.to_wire().into()).collect(),
        figure_ids: g.figures.clone(),
        bounds: g.bounds.map(access::bounds_out),
        max_priority: g.max_priority,
        create_time: Some(timestamp(g.created)),
        expire_time: g.expires.map(timestamp),
        etag: String::new(),
    };
    out.etag = etags::grant(&out);
    out
}

/// A grant as it was written by [`grant_out`].
///
/// # Errors
/// A field that could not be granted today.
pub fn grant_in(g: &pb::Grant) -> Result<Grant, Fault> {
    let (_, id) = access::grant_name("grant.name", &g.name)?;
    let created = access::time("grant.create_time", g.create_time)?;
    Ok(Grant {
        id: id.to_owned(),
        principal: access::principal("grant.principal", &g.principal)?.into(),
        roles: roles("grant.roles", &g.roles)?,
        figures: access::figures("grant.figure_ids", &g.figure_ids)?,
        bounds: access::bounds("grant.bounds", g.bounds.as_ref())?,
        max_priority: access::max_priority("grant.max_priority", g.max_priority)?,
        created: created.unwrap_or_else(SystemTime::now),
        expires: access::time("grant.expire_time", g.expire_time)?,
    })
}

#[tonic::async_trait]
impl AccessService for Api {
    async fn get_caller(
        &self,
        request: Request<pb::GetCallerRequest>,
    ) -> Result<Response<pb::GetCallerResponse>, Status> {
        let result = || {
            let caller = caller(&request)?;
            let claims = &caller.identity.claims;
            let of_server = claims.roles.iter().filter(|r| !r.is_of_world());
            let mut roles: Vec<i32> = of_server.map(|r| r.to_wire().into()).collect();
            let world = &request.get_ref().world;
            if !world.is_empty() {
                let id = world_name("world", world)?;
                // Only callers that may see the world learn whether it exists.
                let rights = match self.worlds.get(id) {
                    Ok(handle) => handle.grants.rights(&caller.identity, id).roles,
                    Err(_) => claims.roles_in(id),
                };
                let in_world = rights.iter().filter(|r| r.is_of_world());
                roles.extend(in_world.map(|r| i32::from(r.to_wire())));
            }
            roles.sort_unstable();
            Ok(pb::GetCallerResponse {
                principal: caller.principal().to_string(),
                roles,
                expire_time: caller.identity.expires.map(timestamp),
            })
        };
        answer(result())
    }

    async fn create_grant(
        &self,
        request: Request<pb::CreateGrantRequest>,
    ) -> Result<Response<pb::CreateGrantResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let handle = api.world(&request, "parent", &r.parent)?;
            let id = new_id("grant_id", &r.grant_id)?.unwrap_or_default();
            let g = r
                .grant
                .as_ref()
                .ok_or_else(|| Fault::invalid("grant", "must be given"))?;
            let grant = Grant {
                id,
                principal: access::principal("grant.principal", &g.principal)?.into(),
                roles: roles("grant.roles", &g.roles)?,
                figures: access::figures("grant.figure_ids", &g.figure_ids)?,
                bounds: access::bounds("grant.bounds", g.bounds.as_ref())?,
                max_priority: access::max_priority("grant.max_priority", g.max_priority)?,
                created: SystemTime::now(),
                expires: access::expiry("grant.expire_time", g.expire_time)?,
            };
            let grant = if r.validate_only {
                handle.grants.would_add(&handle.id, grant)?
            } else {
                handle.grants.add(&handle.id, grant)?
            };
            if !r.validate_only {
                api.stored(&handle).await?;
            }
            Ok(pb::CreateGrantResponse {
                grant: Some(grant_out(&handle.id, &grant)),
            })
        })
        .await
    }

    async fn get_grant(
        &self,
        request: Request<pb::GetGrantRequest>,
    ) -> Result<Response<pb::GetGrantResponse>, Status> {
        let result = || {
            let (world, id) = access::grant_name("name", &request.get_ref().name)?;
            let handle = self.enter(caller(&request)?, world)?;
            Ok(pb::GetGrantResponse {
                grant: Some(grant_out(world, &handle.grants.get(world, id)?)),
            })
        };
        answer(result())
    }

    async fn list_grants(
        &self,
        request: Request<pb::ListGrantsRequest>,
    ) -> Result<Response<pb::ListGrantsResponse>, Status> {
        let result = || {
            let r = request.get_ref();
            let handle = self.world(&request, "parent", &r.parent)?;
            let all = handle.grants.list();
            let items = all.iter().map(|g| (g.id.clone(), grant_out(&handle.id, g)));
            let list = GRANT.name([&handle.id, ""]);
            let (grants, next_page_token) = page(&list, items, r.page_size, &r.page_token)?;
            Ok(pb::ListGrantsResponse {
                grants,
                next_page_token,
            })
        };
        answer(result())
    }

    async fn update_grant(
        &self,
        request: Request<pb::UpdateGrantRequest>,
    ) -> Result<Response<pb::UpdateGrantResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let g = r
                .grant
                .as_ref()
                .ok_or_else(|| Fault::invalid("grant", "must be given"))?;
            let (world, id) = access::grant_name("grant.name", &g.name)?;
            let handle = self.enter(caller(&request)?, world)?;
            let mut update = GrantUpdate::default();
            for field in access::taken(g, r.update_mask.as_ref())? {
                match field {
                    "roles" => update.roles = Some(roles("grant.roles", &g.roles)?),
                    "figure_ids" => {
                        update.figures = Some(access::figures("grant.figure_ids", &g.figure_ids)?);
                    }
                    "bounds" => {
                        update.bounds = Some(access::bounds("grant.bounds", g.bounds.as_ref())?);
                    }
                    "max_priority" => {
                        let priority = access::max_priority("grant.max_priority", g.max_priority)?;
                        update.max_priority = Some(priority);
                    }
                    _ => {
                        update.expires = Some(access::expiry("grant.expire_time", g.expire_time)?);
                    }
                }
            }
            let same = |now: &Grant| {
                let etag = || grant_out(world, now).etag;
                etags::check(&g.name, &g.etag, etag)
            };
            let grant = handle
                .grants
                .update(world, id, (update, r.validate_only), same)?;
            if !r.validate_only {
                self.stored(&handle).await?;
            }
            Ok(pb::UpdateGrantResponse {
                grant: Some(grant_out(world, &grant)),
            })
        };
        answer(result.await)
    }

    async fn delete_grant(
        &self,
        request: Request<pb::DeleteGrantRequest>,
    ) -> Result<Response<pb::DeleteGrantResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (world, id) = access::grant_name("name", &r.name)?;
            let handle = api.enter(caller(&request)?, world)?;
            let same = |now: &Grant| {
                let etag = || grant_out(world, now).etag;
                etags::check(&r.name, &r.etag, etag)
            };
            handle.grants.remove(world, id, same)?;
            api.stored(&handle).await?;
            Ok(pb::DeleteGrantResponse {})
        })
        .await
    }
}
