-- Made when they are missing whenever a catalogue is opened to write: they are no part of the schema.
CREATE INDEX IF NOT EXISTS episode_by_task ON episode (task, variation, seed);
CREATE INDEX IF NOT EXISTS segment_by_skill ON segment (skill, kind, outcome);
CREATE INDEX IF NOT EXISTS segment_of_kind ON segment (episode, undone, kind, first_frame);
CREATE INDEX IF NOT EXISTS fact_by_predicate ON fact (predicate, arg1, arg2);
CREATE INDEX IF NOT EXISTS fact_by_text ON fact (episode, fact, start_step, end_step, open_end);
CREATE INDEX IF NOT EXISTS effect_by_fact ON segment_effect (episode, undone, segment, fact);
CREATE INDEX IF NOT EXISTS fact_by_start ON fact (episode, start_step);
CREATE INDEX IF NOT EXISTS fact_by_end ON fact (episode, end_step);
CREATE INDEX IF NOT EXISTS skill_call ON segment (skill, case_name, kind, undone, outcome, try_number, effect_held,
  start_step, end_step, parent) WHERE kind = 'skill';
CREATE INDEX IF NOT EXISTS segment_failed ON segment (episode, undone) WHERE outcome = 'failure';
CREATE INDEX IF NOT EXISTS asked_at ON agent_action (episode, frame, end_frame);
CREATE INDEX IF NOT EXISTS effect_missing ON segment_effect (episode, segment) WHERE held = 0;
CREATE INDEX IF NOT EXISTS fact_hidden ON fact (episode, predicate, observed) WHERE observed = 0;
