//! `sinew grant`: grants roles in a world, takes them back, and lists them.

use super::args::CredentialArgs;
use super::exit::UsageError;
use super::remote::{explain, world_resource};
use super::terminal::print_line;
use sinew_client::Client;
use sinew_wire::pb;
use tonic::Code;

/// Arguments of `sinew grant`.
#[derive(Clone, Debug, clap::Args)]
pub struct GrantArgs {
    /// Server, host:port or https://host:port
    address: String,
    /// World, for example `stage`
    world: String,
    /// To whom: `user:NAME`, `cert:NAME` or `*`; without one the grants are listed
    principal: Option<String>,
    /// Role: viewer, perturber, driver, director or owner (repeatable)
    #[arg(long = "role", value_name = "ROLE", requires = "principal")]
    roles: Vec<String>,
    /// Figure that a driver may drive (repeatable) [default: all]
    #[arg(long = "figure", value_name = "NAME")]
    figures: Vec<String>,
    /// Largest force of a perturber, N
    #[arg(long, value_name = "N")]
    max_force: Option<f64>,
    /// Perturbations per second of a perturber
    #[arg(long, value_name = "HZ")]
    max_rate: Option<f64>,
    /// Take the grants of this principal back
    #[arg(long, conflicts_with = "roles")]
    revoke: bool,
    /// Create the world if there is none
    #[arg(long)]
    create_world: bool,
    #[command(flatten)]
    credentials: CredentialArgs,
}

fn role(name: &str) -> anyhow::Result<i32> {
    let wire = format!("ROLE_{}", name.to_uppercase());
    let role =
        pb::Role::from_str_name(&wire).filter(|_| name.chars().all(|c| c.is_ascii_lowercase()));
    let role = role.ok_or_else(|| UsageError(format!("there is no role {name:?}")))?;
    Ok(role.into())
}

/// Grants, revokes or lists roles.
///
/// # Errors
/// No server, no such world, or the server refuses.
pub fn run(args: &GrantArgs) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        let client = args.credentials.connect(&args.address).await?;
        let world = world_resource(&args.world);
        if args.create_world {
            create(&client, &world).await?;
        }
        match &args.principal {
            None => list(&client, &world).await,
            Some(who) if args.revoke => revoke(&client, &world, who).await,
            Some(_) if args.roles.is_empty() => {
                Err(UsageError("give a --role, or --revoke".into()).into())
            }
            Some(who) => grant(args, &client, &world, who).await,
        }
    })
}

async fn create(client: &Client, world: &str) -> anyhow::Result<()> {
    let request = pb::CreateWorldRequest {
        world_id: world.trim_start_matches("worlds/").to_owned(),
        ..Default::default()
    };
    match client.worlds().create_world(request).await {
        Err(e) if e.code() != Code::AlreadyExists => Err(explain(&e)),
        _ => Ok(()),
    }
}

async fn grant(args: &GrantArgs, client: &Client, world: &str, who: &str) -> anyhow::Result<()> {
    let bounded = args.max_force.is_some() || args.max_rate.is_some();
    let bounds = bounded.then_some(pb::PerturbationBounds {
        max_force_newtons: args.max_force,
        max_rate_hz: args.max_rate,
        max_mass_kg: None,
    });
    let grant = pb::Grant {
        principal: who.to_owned(),
        roles: args
            .roles
            .iter()
            .map(|r| role(r))
            .collect::<Result<_, _>>()?,
        figure_ids: args.figures.clone(),
        bounds,
        ..Default::default()
    };
    let request = pb::CreateGrantRequest {
        parent: world.to_owned(),
        grant_id: String::new(),
        grant: Some(grant),
        ..Default::default()
    };
    let made = client
        .access()
        .create_grant(request)
        .await
        .map_err(|e| explain(&e))?;
    show(&made.into_inner().grant.unwrap_or_default())
}

async fn all(client: &Client, world: &str) -> anyhow::Result<Vec<pb::Grant>> {
    let request = pb::ListGrantsRequest {
        parent: world.to_owned(),
        page_size: 1000, // more than a world holds
        page_token: String::new(),
    };
    let listed = client.access().list_grants(request).await;
    Ok(listed.map_err(|e| explain(&e))?.into_inner().grants)
}

async fn list(client: &Client, world: &str) -> anyhow::Result<()> {
    all(client, world).await?.iter().try_for_each(show)
}

async fn revoke(client: &Client, world: &str, who: &str) -> anyhow::Result<()> {
    for grant in all(client, world)
        .await?
        .into_iter()
        .filter(|g| g.principal == who)
    {
        let request = pb::DeleteGrantRequest {
            name: grant.name.clone(),
            ..Default::default()
        };
        client
            .access()
            .delete_grant(request)
            .await
            .map_err(|e| explain(&e))?;
        print_line(&format!("{} is gone", grant.name))?;
    }
    Ok(())
}

fn show(grant: &pb::Grant) -> anyhow::Result<()> {
    print_line(&line(grant))
}

/// A grant in a line.
fn line(grant: &pb::Grant) -> String {
    let roles: Vec<String> = grant
        .roles()
        .map(|r| r.as_str_name().trim_start_matches("ROLE_").to_lowercase())
        .collect();
    let mut line = format!(
        "{}: {} is {}",
        grant.name,
        grant.principal,
        roles.join(", ")
    );
    if !grant.figure_ids.is_empty() {
        line += &format!(" of {}", grant.figure_ids.join(", "));
    }
    let bounds = grant.bounds.unwrap_or_default();
    for (what, most, unit) in [
        ("forces", bounds.max_force_newtons, "N"),
        ("loads", bounds.max_mass_kg, "kg"),
        ("perturbations", bounds.max_rate_hz, "per s"),
    ] {
        if let Some(most) = most {
            line += &format!(", {what} up to {most} {unit}");
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grants_are_shown_with_their_bounds() {
        let mut grant = pb::Grant {
            name: "worlds/stage/grants/1".into(),
            principal: "user:ada".into(),
            roles: vec![pb::Role::Perturber.into()],
            ..Default::default()
        };
        let plain = "worlds/stage/grants/1: user:ada is perturber";
        assert_eq!(line(&grant), plain);
        grant.bounds = Some(pb::PerturbationBounds {
            max_force_newtons: Some(50.0),
            max_rate_hz: Some(0.5),
            max_mass_kg: None,
        });
        let bounded = format!("{plain}, forces up to 50 N, perturbations up to 0.5 per s");
        assert_eq!(line(&grant), bounded);
    }
}
