//! Conversions between the types of this crate and those of `nalgebra`, for callers that compute with results.
//!
//! The kernels keep types of their own: they are generic over [`Lane`](super::Lane), never fuse operations, and their
//! fields have names. Conversions copy; a rotation that is not of unit length is normalised.

use super::{Mat3, Quat, Sym3, Vec3};
use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};

impl From<Vec3> for Vector3<f64> {
    fn from(v: Vec3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<Vector3<f64>> for Vec3 {
    fn from(v: Vector3<f64>) -> Self {
        let [x, y, z] = v.into();
        Self { x, y, z }
    }
}

impl From<Vec3> for Point3<f64> {
    fn from(v: Vec3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<Point3<f64>> for Vec3 {
    fn from(p: Point3<f64>) -> Self {
        p.coords.into()
    }
}

impl From<Quat> for UnitQuaternion<f64> {
    fn from(q: Quat) -> Self {
        Self::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z))
    }
}

impl From<UnitQuaternion<f64>> for Quat {
    fn from(q: UnitQuaternion<f64>) -> Self {
        let [x, y, z, w] = q.coords.into();
        Self { x, y, z, w }
    }
}

impl From<Mat3> for Matrix3<f64> {
    fn from(m: Mat3) -> Self {
        Self::from_columns(&[m.x.into(), m.y.into(), m.z.into()])
    }
}

impl From<Matrix3<f64>> for Mat3 {
    fn from(m: Matrix3<f64>) -> Self {
        let [x, y, z] = [0, 1, 2].map(|k| m.column(k).into_owned().into());
        Self { x, y, z }
    }
}

impl From<Sym3> for Matrix3<f64> {
    fn from(s: Sym3) -> Self {
        Self::new(s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TURN: Quat = Quat {
        x: 0.1,
        y: -0.5,
        z: 0.7,
        w: 0.5,
    };
    const PLACE: Vec3 = Vec3 {
        x: 0.3,
        y: -1.25,
        z: 4.5,
    };

    #[test]
    fn values_come_back_as_they_went() {
        assert_eq!(Vec3::from(Vector3::from(PLACE)), PLACE);
        assert_eq!(Vec3::from(Point3::from(PLACE)), PLACE);
        assert_eq!(Quat::from(UnitQuaternion::from(TURN)), TURN);
        let m = TURN.to_mat3();
        assert_eq!(Mat3::from(Matrix3::from(m)), m);
    }

    #[test]
    fn both_rotate_alike() {
        let ours = Vector3::from(TURN.rotate(PLACE));
        let by_quaternion = UnitQuaternion::from(TURN) * Vector3::from(PLACE);
        let by_matrix = Matrix3::from(TURN.to_mat3()) * Vector3::from(PLACE);
        assert!((ours - by_quaternion).norm() < 1e-14);
        assert!((ours - by_matrix).norm() < 1e-14);
    }

    #[test]
    fn a_rotated_tensor_is_the_product_of_matrices() {
        let tensor = Sym3::diagonal(0.3, 0.2, 0.1);
        let r = Matrix3::from(TURN.to_mat3());
        let product = r * Matrix3::from(tensor) * r.transpose();
        let ours = Matrix3::from(tensor.rotated(TURN.to_mat3()));
        assert!((product - ours).norm() < 1e-15);
    }
}
