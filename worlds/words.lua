-- English, as far as checks of sentences know it: what each word is, its forms, and what grammar asks of it.
--
-- Nouns of things stand with their types and objects (`nouns`), and verbs of skills with these (`verbs`); what is listed
-- here are the words that belong to none, and synonyms. A further root's worlds/words.lua adds to this one.
return {
  -- Words by kind: texts of words, each its own sense, or SENSE = its synonyms. A word of several kinds is what its
  -- neighbours ask for, else the first of these; one of none is unknown, and a sentence that has it is turned down.
  kinds = {
    grammar = {
      "a an the this that these those its it their they them there here which who whose what is are be been",
      "being was were am has have had do does did can could should must may might will would shall and or but",
      "so as of to for by with at in into on onto upon from off out over above under below up down away",
      "inside within through along against around across between among toward about beneath beside near back",
      "together if when while until because since also too still already yet else than such very just only i",
      "you we your my our me us he she his her themselves itself yourself let make sure ensure need want use",
      "using how where way each every any some both all several same own whole it's that's there's please",
      "kindly now anymore longer somewhere aside i'm i've another outof i'd i'll let's like begin start",
      "continue proceed keep allow help try become stay thing something somebody someone everything anything",
      "object item task job one's forgotten",
    },
    harmless = {
      "carefully gently slowly softly safely quickly firmly securely properly neatly precisely exactly",
      "correctly completely fully entirely tightly smoothly steadily lightly directly straight well careful",
      "gentle simply again once far close-by nearby correct proper right-hand-side robot arm gripper",
      "fingertip finger fingers fingertips available sure ready able possible position place spot location",
      "work workspace inside-out upright flat level high aloft further your time quick goal aim whichever",
      "slow steady firm necessary required desired appropriate designated specific given particular current",
      "respective respectively accordingly",
    },
    exclusion = {
      "except besides alone untouched unmoved ignore ignoring spare",
      other = "other others rest remaining",
    },
    negation = {
      "not no never don't doesn't won't can't cannot isn't aren't without avoid refrain neither nor nothing",
      "none nobody stop instead rather unless hardly dont doesnt shouldn't mustn't couldn't wouldn't stops",
      "avoiding prevent nowhere",
    },
    order = {
      "before",
      first = "first firstly initially",
      ["then"] = "then next afterwards subsequently afterward followed following secondly",
      last = "finally lastly last eventually", after = "after once",
    },
    number = {
      ["0"] = "zero", ["1"] = "one single", ["2"] = "two both pair couple", ["3"] = "three", ["4"] = "four",
      ["5"] = "five", ["6"] = "six", ["7"] = "seven", ["8"] = "eight", ["9"] = "nine", ["10"] = "ten",
      ["12"] = "twelve dozen", half = "half-a",
    },
    place = {
      "second third fourth first last",
      left = "left leftmost left-hand leftward", right = "right rightmost right-hand rightward",
      top = "top upper uppermost topmost highest", bottom = "bottom lower lowest bottommost undermost",
      middle = "middle central centre center centermost", front = "front foremost nearest closest",
      behind = "behind rear rearmost hind furthest farthest", outer = "outer outermost",
    },
    adjective = {
      "wooden metal plastic low round square empty full bare free clean dirty hot cold dark bright heavy",
      "light-weight lit open-topped closed-up old new ripe broken soft hard",
      big = "big large huge tall long wide", small = "small little tiny short narrow",
    },
    colour = {
      "red green blue yellow black white grey orange purple violet cyan magenta pink brown navy teal olive",
      "maroon azure lime rose silver gold golden beige turquoise crimson scarlet",
      grey = "gray",
    },
    noun = {
      "cylinder prism star bowl drawer button paper desk cabinet freezer microwave dishwasher usb stick port",
      "lamp light water clock remote control channel toilet seat roll holder stand hanger frame tube shoe",
      "book shelf rack slot post board fork spoon mat tray meat chicken pepper tomato bottle wine jar safe",
      "scale window hoop net ring puzzle piece sorter checker chess pawn king queen rook knight bishop square",
      "target patch tree tower stack pile pyramid ice soup coffee mustard sugar tuna jelly cracker hand edge",
      "end wall air chair bed basket key apple banana sink kettle toaster shirt hat toy car screw hammer",
      "spatula vase flower basin hood mark space dial screen keyboard opening",
      glass = "glass tumbler", cap = "cap screwtop", handle = "handle grip lever knob", table = "table tabletop",
      socket = "socket outlet", pin = "pin prong", cradle = "cradle dock base", rod = "rod rail bar",
      hook = "hook peg", hole = "hole gap", zone = "zone region area volume", spoke = "spoke branch",
      item = "grocery", colour = "colour color", shape = "shape solid", side = "side half", floor = "floor ground",
      counter = "counter worktop", sofa = "sofa couch", bag = "bag sack", pen = "pen pencil",
      ["orange-fruit"] = "oranges", number = "number digit", order = "sequence",
    },
    verb = {
      "hold empty lower serve setup slide pour clear stand contain",
      open = "open unlatch unlock uncover", close = "close shut", unscrew = "unscrew untwist",
      take = "take grab grasp grip get fetch collect seize retrieve pick obtain gather clutch",
      find = "find locate search look identify select choose",
      remove = "disconnect remove extract withdraw eject unplug detach unload unpack unhook free",
      lift = "lift raise hoist elevate",
      put = "put place lay set rest deposit store stow leave return deliver transfer move bring carry tuck load pack position arrange tidy replace relocate shift dock shelve bin seat post stick stash park slip pop",
      drop = "drop release throw toss fall falls", insert = "insert plug fit connect slot-in feed attach",
      stack = "nest stack pile heap", build = "build construct assemble create form make",
      hang = "hang suspend dangle hook", press = "press depress tap click hit", pull = "pull draw tug yank",
      swing = "swing fold tilt flip", push = "push shove nudge", drag = "drag sweep",
      turn = "turn rotate twist spin", switch = "switch activate deactivate", point = "point direct",
      reach = "reach touch approach", sort = "sort separate organise organize", weigh = "weigh measure",
      cut = "cut slice chop", clean = "clean wipe wash scrub", cook = "cook bake boil fry heat",
      ["break"] = "break smash crush", shake = "shake stir", throw = "hurl", eat = "eat drink taste",
      belong = "belong go come goes end", complete = "complete finish accomplish achieve perform execute",
      lie = "lie sit", locate = "located", mark = "marked labelled labeled numbered", show = "show say bear",
      colour = "coloured colored painted", ["take-care"] = "care",
    },
  },

  -- Forms: an ending and what stands there in the word itself. `done`: done to what was named, as `the door pushed shut`.
  endings = {
    { "ied", "y" }, { "ies", "y", plural = true }, { "ves", "f", plural = true },
    { "ses", "s", plural = true }, { "xes", "x", plural = true }, { "zes", "z", plural = true },
    { "ches", "ch", plural = true }, { "shes", "sh", plural = true }, { "oes", "o", plural = true },
    { "s", "", plural = true, unless = "ss" },
    { "ing", "" }, { "ing", "e" }, { "ed", "", done = true }, { "ed", "e", done = true },
  },
  irregular = {
    took = "take", taken = "take", laid = "lay", lying = "lie", held = "hold", found = "find", stood = "stand",
    got = "get", brought = "bring", hung = "hang", built = "build", putting = "put", kept = "keep", broke = "break",
    slid = "slide", swung = "swing", drawn = "draw", shown = "show", thrown = "throw", people = "person", men = "man",
    dies = "die", tying = "tie", knives = { "knife", plural = true },
  },

  -- What phrases are read as: MEANING = the phrase, or a list of them.
  phrases = {
    ["serve the table"] = { "set the table", "lay the table" },
    hold = { "take hold of", "get hold of", "keep hold of" },
    drop = { "let go", "let go of" },
    ["usb stick"] = { "memory stick", "flash drive", "thumb drive", "usb drive" },
    take = { "pick up", "picks up", "picking up" },
    outof = { "out of", "away from" },
    navy = { "dark blue", "dark-blue" },
    maroon = { "dark red", "dark-red" },
    ["then"] = {
      "followed by", "go on to", "after that", "after it", "after this", "after both", "after them", "after which",
    },
    up = {
      "one on top of another", "one on top of the other", "on top of each other", "on top of one another",
      "one upon another",
    },
    there = { "where it is", "where they are", "where it stands" },
    ensure = { "make sure", "making sure" },
    except = { "any colour but", "every colour but", "anything but", "all but" },
    please = { "would you mind", "do you mind" },
    ["half-a"] = { "half a", "half an" },
    remove = "get rid of", setup = "set up", quarter = "a quarter", onto = "on top of",
    ["before-thing"] = "in front of", beside = "next to", near = "close to", ["1 of"] = "one of",
    upright = "right side up", facedown = "face down", upsidedown = "upside down", quickly = "at once",
    ["lift it"] = "bring it up", ["lift them"] = "bring them up", lift = "bring up", build = "put up",
    fully = "all the way", ["i want"] = "i'd like", want = "would like", now = "right now", slightly = "a little",
    to = "in order to", sidebyside = "side by side", simultaneously = "at the same time", also = "as well",
    anymore = "any more", ["not longer"] = "no longer", ["been forgotten"] = "been left",
    ["have forgotten"] = "have left", ["has forgotten"] = "has left", ["is forgotten"] = "is left",
    ["was forgotten"] = "was left", ["being forgotten"] = "being left", ["somebody forgotten"] = "somebody left",
    ["someone forgotten"] = "someone left",
  },

  -- Verbs whose meaning another word brings.
  light_verbs = {
    { verbs = "make makes making made", with = "tower stack pile pyramid go", unless = true },
    { verbs = "get getting", with = "into onto to", means = "put" },
    { verbs = "turn turns turning turned", with = "on off", beside = true, means = "switch" },
  },
  particles = { -- that belong to a verb: `switch on the lamp`
    switch = "on off", turn = "on off", insert = "in", push = "in", slide = "in",
    take = "off", pull = "off", lift = "off", remove = "off", clean = "off",
  },

  -- What a thing is after a preposition: where something goes to or comes from, its whole, a means; else as they say.
  prepositions = {
    to = "on onto upon in into inside within to at toward towards", from = "from off outof", of = "of", with = "with by",
    over = "over", above = "above", under = "under", below = "below", beneath = "beneath", behind = "behind",
    beside = "beside", near = "near", between = "between", around = "around", through = "through",
    against = "against", across = "across", along = "along", ["before-thing"] = "before-thing", ["for"] = "for",
  },
  directions = { -- of verbs
    open = "open", close = "close", up = "lift", down = "lower", pull = "pull", push = "push", insert = "insert",
    remove = "remove",
  },
  opposites = {
    open = "close", up = "down", ["in"] = "out", switch_on = "switch_off", push = "pull", plus = "minus",
    next = "previous", forward = "backward", clockwise = "anticlockwise", insert = "remove",
  },
  ranks = { first = 1, second = 2, third = 3, fourth = 4, last = 99 }, -- turns; 99: the end, whatever else is ranked

  classes = {
    -- How words stand in a sentence.
    article = "a an the its their this that these those your each every all any same own both", -- before a noun
    -- what comes next is a noun:
    noun_follows = "a an the its their this that these those your each every all both other another 's no same own which "
      .. "any of",
    -- what comes next is a verb:
    verb_follows = "to and then please or not don't you it never must should can will would could may might them that "
      .. "let first by kindly now which is be been being",
    modal = "can", -- a noun too, and none where a verb is due
    join = "and then but while until so because after before once when or if afterwards", -- begins a stretch
    after = "after once", -- what follows comes first
    before = "before", -- what follows comes last
    ["until"] = "until",
    of = "of",
    with = "with",
    by = "by",
    where = "where",
    from = "from outof",
    on = "on",
    upon = "on onto upon", -- ways on
    inside = "in inside into within", -- ways in
    into = "into in",
    towards = "to onto",
    away = "off out outof from",
    off = "off",
    back = "back",
    above = "above over",
    located = "in on inside within behind", -- says where a thing is, not only where it goes
    sided = "on at in", -- on the left
    -- tells, though it is grammar:
    way = "on onto upon in into inside within to from off outof of with at over above under below beneath "
      .. "behind beside near between around through against across toward towards along before-thing by for up "
      .. "down out",
    telling = "up down next", -- tells variations apart, though it is grammar
    relative = "that that's which who",
    be = "is are be was were",
    demanding = "should must needs has ought goes belongs", -- what follows is wanted
    painted = "coloured colored painted",
    one = "one ones", -- stands for a noun
    several = "ones others",
    others = "others rest remaining",
    other = "other",
    both = "both",
    all = "all both",
    polite = "a an the please kindly now you can could", -- with it a sentence says no more than without
    again = "again",
    already = "already",
    instead = "instead",
    excuse = "sorry ai assistant language apologize apologise unable assist sure", -- of a model that will not answer
    -- What is left alone.
    sparing = "spare alone untouched",
    keeping = "leave leaving leaves keep keeping keeps stay stays still",
    leaving = "leave leaves leaving",
    shut = "shut closed",
    openness = "open close closed shut",
    state = "open wide ajar shut closed up empty", -- after it, a noun's verb says how a thing is: let it stand open
    standing = "stands lies rests hangs ends stick", -- so does this verb
    -- before openness: it is so, and is not made so:
    in_state = "stands stand left forgotten is are wide been already still",
    stative = "be is are stay remain left forgotten leave leaving leaves belong", -- how things are
    lasting = "belong lie stand hang open close put", -- verbs of how things are
    -- Nouns that rules know.
    built = "tower stack pile pyramid", -- is there only once it is done
    general = "side order colour space thing end number hand shape item", -- names nothing of a scene
    general_type = "thing fixture region furniture level", -- types that nobody speaks of
    grip = "handle",
    air = "air",
    table = "table", -- goes without saying
    -- Verbs that rules know.
    giving = "give giving", -- give it a push
    given = "push shove pull twist press turn tap nudge tug",
    getting = "get", -- get it open
    going = "go", -- go to it
    holding = "hold",
    taking = "take remove lift find hold pull clear", -- what stands on a place is taken from there
    putting = "put insert drop stack hang stand lower point lift",
    putting_up = "put",
    assembling = "build",
    hanging = "hang",
    implying = "hang insert", -- where it goes is said with it, if there is one such place
    belonging = "belong",
    stating = "is are belong be should want",
    wishing = "is are be want need",
    switching = "switch switch_on switch_off",
    turning = "turn",
    swinging = "swing",
  },
}
