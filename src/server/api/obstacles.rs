//! `ObstacleService`.

use super::{Api, answer, caller, origin};
use sinew_wire::convert::names::OBSTACLE;
use sinew_wire::convert::{new_id, obstacle, obstacle_name, page};
use sinew_wire::pb::{self, obstacle_service_server::ObstacleService};
use sinew_wire::status::Fault;
use tonic::{Request, Response, Status};

#[tonic::async_trait]
impl ObstacleService for Api {
    async fn create_obstacle(
        &self,
        request: Request<pb::CreateObstacleRequest>,
    ) -> Result<Response<pb::CreateObstacleResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let handle = api.world(&request, "parent", &r.parent)?;
            let id = new_id("obstacle_id", &r.obstacle_id)?;
            let setup = obstacle::setup("obstacle", r.obstacle.as_ref())?;
            let only = r.validate_only;
            let info = handle
                .call(origin(&request), move |s| {
                    if only {
                        s.would_add_obstacle(id, setup)
                    } else {
                        s.add_obstacle(id, setup)
                    }
                })
                .await?;
            if !only {
                api.stored(&handle).await?;
            }
            Ok(pb::CreateObstacleResponse {
                obstacle: Some(obstacle::out(&handle.id, &info)),
            })
        })
        .await
    }

    async fn get_obstacle(
        &self,
        request: Request<pb::GetObstacleRequest>,
    ) -> Result<Response<pb::GetObstacleResponse>, Status> {
        let result = || {
            let name = &request.get_ref().name;
            let (world, id) = obstacle_name("name", name)?;
            let latest = self.enter(caller(&request)?, world)?.latest();
            let found = latest.obstacles.iter().find(|o| o.id == id);
            let found = found.ok_or_else(|| Fault::not_found("obstacle", name))?;
            Ok(pb::GetObstacleResponse {
                obstacle: Some(obstacle::out(world, found)),
            })
        };
        answer(result())
    }

    async fn list_obstacles(
        &self,
        request: Request<pb::ListObstaclesRequest>,
    ) -> Result<Response<pb::ListObstaclesResponse>, Status> {
        let result = || {
            let r = request.get_ref();
            let handle = self.world(&request, "parent", &r.parent)?;
            let latest = handle.latest();
            // Numbers grow in the order of creation; padded they sort as text.
            let items = latest
                .obstacles
                .iter()
                .map(|o| (format!("{:020}", o.number), obstacle::out(&handle.id, o)));
            let list = OBSTACLE.name([&handle.id, ""]);
            let (obstacles, next_page_token) = page(&list, items, r.page_size, &r.page_token)?;
            Ok(pb::ListObstaclesResponse {
                obstacles,
                next_page_token,
            })
        };
        answer(result())
    }

    async fn update_obstacle(
        &self,
        request: Request<pb::UpdateObstacleRequest>,
    ) -> Result<Response<pb::UpdateObstacleResponse>, Status> {
        let result = async {
            let r = request.get_ref();
            let o = r
                .obstacle
                .as_ref()
                .ok_or_else(|| Fault::invalid("obstacle", "must be given"))?;
            let (world, id) = obstacle_name("obstacle.name", &o.name)?;
            let handle = self.enter(caller(&request)?, world)?;
            let update = obstacle::update(o, r.update_mask.as_ref())?;
            let (id, etag, only) = (id.to_owned(), o.etag.clone(), r.validate_only);
            let info = handle
                .call(origin(&request), move |s| {
                    let now = s.obstacle_now(&id)?;
                    obstacle::check_etag(s.id(), &now, &etag)?;
                    let setup = update.apply(&now.setup)?;
                    if only {
                        s.would_update_obstacle(now, setup)
                    } else {
                        s.update_obstacle(&id, setup)
                    }
                })
                .await?;
            if !only {
                self.stored(&handle).await?;
            }
            Ok(pb::UpdateObstacleResponse {
                obstacle: Some(obstacle::out(&handle.id, &info)),
            })
        };
        answer(result.await)
    }

    async fn delete_obstacle(
        &self,
        request: Request<pb::DeleteObstacleRequest>,
    ) -> Result<Response<pb::DeleteObstacleResponse>, Status> {
        self.once(request, |api, request| async move {
            let r = request.get_ref();
            let (world, id) = obstacle_name("name", &r.name)?;
            let handle = api.enter(caller(&request)?, world)?;
            let (id, etag) = (id.to_owned(), r.etag.clone());
            handle
                .call(origin(&request), move |s| {
                    obstacle::check_etag(s.id(), &s.obstacle_now(&id)?, &etag)?;
                    s.remove_obstacle(&id)
                })
                .await?;
            api.stored(&handle).await?;
            Ok(pb::DeleteObstacleResponse {})
        })
        .await
    }
}
