CREATE VIEW objects AS
SELECT o.episode, (SELECT k.task FROM episode k WHERE k.id = o.episode) AS task,
       o.name AS object, o.kind, o.class, o.type, o.size_x, o.size_y, o.size_z, o.mask_id,
       (SELECT value FROM object_attribute a WHERE a.episode = o.episode AND a.object = o.ordinal AND a.name = 'colour')
         AS colour,
       (SELECT json_group_array(trait) FROM (SELECT trait FROM object_trait t
         WHERE t.episode = o.episode AND t.object = o.ordinal ORDER BY t.ordinal)) AS traits,
       (SELECT json_group_object(name, value) FROM (SELECT name, value FROM object_attribute a
         WHERE a.episode = o.episode AND a.object = o.ordinal ORDER BY name)) AS attributes
FROM object o;
