-- What there is: kind (body, part, region or hand), class, PDDL type, bounding box (m), colour, traits (a JSON list).
SELECT object, kind, class, type, size_x, size_y, size_z, colour, traits FROM objects WHERE episode = ?1 ORDER BY object;
