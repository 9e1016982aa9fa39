CREATE VIEW cameras AS
SELECT c.episode, (SELECT k.task FROM episode k WHERE k.id = c.episode) AS task,
       c.name AS camera, c.width, c.height, c.focal_x, c.focal_y, c.centre_x, c.centre_y, c.k1, c.k2, c.p1,
       c.p2, c.k3, c.vertical_fov_rad, c.near_m, c.far_m, c.mount_link AS mount, c.x, c.y, c.z, c.qx, c.qy, c.qz, c.qw
FROM camera c;
