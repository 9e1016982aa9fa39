// The words that the parser knows by itself; what things are called comes from the library, and from a task's own
// sentences. A line is `kind sense [skills]: words`; the skills are those that a verb may tell of. What is known of
// no kind is unknown, and a sentence with such a word is turned down.
#include "scripting/language/lexicon.h"

namespace stampede {

const char* const kLexiconText = R"(
function -: a an the this that these those its it their they them there here which who whose what
function -: is are be been being was were am has have had do does did can could should must may might will would shall
function -: and or but so as of to for by with at in into on onto upon from off out over above under below up down away
function -: inside within through along against around across between among toward about beneath beside near by
function -: back together if when while until because since also too still already yet else than such very just only
function -: i you we your my our me us he she his her themselves itself yourself let make sure ensure need want use using how where way
function -: each every any some both all several same own whole it's that's there's please please kindly now
function -: anymore longer somewhere aside i'm i've
function -: another outof i'd i'll let's
function -: would like begin start continue proceed keep allow help try become stay so that
function -: thing something somebody someone everything anything object item task job one's itself
harmless -: carefully gently slowly softly safely quickly firmly securely properly neatly precisely exactly correctly
harmless -: completely fully entirely tightly smoothly steadily lightly directly straight well careful gentle
harmless -: simply again once far close-by nearby correct proper right-hand-side robot arm gripper fingertip finger fingers fingertips
harmless -: available sure ready able possible position place spot location work workspace inside-out upright flat level
harmless -: high aloft further
harmless -: your time quick goal aim whichever carefully slow steady firm necessary required desired appropriate designated
harmless -: specific given particular current respective respectively accordingly
exclusion other: other others rest remaining
exclusion -: except besides alone untouched unmoved ignore ignoring spare
negation -: not no never don't doesn't won't can't cannot isn't aren't without avoid refrain neither nor nothing none nobody stop
negation -: instead rather unless hardly dont doesnt shouldn't mustn't couldn't wouldn't stops avoiding prevent nowhere
order first: first firstly initially
order then: then next afterwards subsequently afterward followed following secondly
order last: finally lastly last eventually
order after: after once
order before: before
number 0: zero
number 1: one single
number 2: two both pair couple
number 3: three
number 4: four
number 5: five
number 6: six
number 7: seven
number 8: eight
number 9: nine
number 10: ten
number 12: twelve dozen
place left: left leftmost left-hand leftward
place right: right rightmost right-hand rightward
place top: top upper uppermost topmost highest
place bottom: bottom lower lowest bottommost undermost
place middle: middle central centre center centermost
place front: front foremost nearest closest
place behind: behind rear rearmost hind furthest farthest
place outer: outer outermost
place second: second
place third: third
place fourth: fourth
adjective big: big large huge tall long wide
adjective small: small little tiny short narrow
adjective -: wooden metal plastic low round square empty full bare free clean dirty hot cold dark bright heavy light-weight
adjective -: lit open-topped closed-up old new ripe broken soft hard
colour -: red green blue yellow black white grey orange purple violet cyan magenta pink brown navy teal olive maroon
colour -: azure lime rose silver gold golden beige turquoise crimson scarlet
colour grey: gray
noun block: block cube brick
noun cylinder: cylinder
noun prism: prism
noun star: star
noun moon: moon crescent
noun cup: cup mug beaker
noun glass: glass tumbler
noun plate: plate dish
noun bowl: bowl
noun drawer: drawer
noun chest: chest dresser
noun lid: lid cover
noun cap: cap screwtop
noun door: door flap
noun handle: handle grip lever knob
noun button: button
noun box: box container crate
noun bin: bin wastebasket dustbin
noun rubbish: rubbish trash garbage waste litter
noun paper: paper
noun table: table tabletop
noun desk: desk
noun cupboard: cupboard pantry
noun cabinet: cabinet
noun fridge: fridge refrigerator
noun freezer: freezer
noun oven: oven cooker stove
noun microwave: microwave
noun grill: grill barbecue bbq grate
noun dishwasher: dishwasher
noun laptop: laptop notebook
noun computer: computer pc machine
noun usb: usb
noun stick: stick
noun port: port
noun socket: socket outlet
noun charger: charger adapter
noun pin: pin prong
noun phone: phone handset telephone smartphone
noun cradle: cradle dock base
noun lamp: lamp
noun light: light
noun tap: tap faucet
noun water: water
noun clock: clock
noun television: television tv telly
noun remote: remote
noun control: control
noun channel: channel
noun toilet: toilet
noun seat: seat
noun roll: roll
noun holder: holder
noun rod: rod rail bar
noun stand: stand
noun hook: hook peg
noun hanger: hanger
noun picture: picture painting
noun frame: frame
noun umbrella: umbrella parasol
noun tube: tube
noun shoe: shoe
noun book: book
noun bookshelf: bookshelf bookcase
noun shelf: shelf
noun rack: rack
noun slot: slot
noun post: post
noun board: board
noun knife: knife blade
noun fork: fork
noun spoon: spoon
noun cutlery: cutlery silverware
noun mat: mat
noun napkin: napkin serviette
noun tray: tray
noun pan: pan pot saucepan
noun meat: meat
noun steak: steak beef
noun chicken: chicken
noun pepper: pepper
noun tomato: tomato
noun bottle: bottle
noun wine: wine
noun jar: jar
noun safe: safe
noun money: money cash banknote note
noun scale: scale
noun switch: switch rocker
noun window: window
noun ball: ball basketball
noun hoop: hoop
noun net: net
noun ring: ring
noun puzzle: puzzle
noun piece: piece
noun hole: hole gap
noun sorter: sorter
noun checker: checker
noun chess: chess
noun pawn: pawn
noun king: king
noun queen: queen
noun rook: rook
noun knight: knight
noun bishop: bishop
noun square: square
noun target: target
noun zone: zone region area volume
noun patch: patch
noun tree: tree
noun spoke: spoke branch
noun tower: tower
noun stack: stack
noun pile: pile
noun pyramid: pyramid
noun ice: ice
noun tin: tin can
noun item: grocery
noun soup: soup
noun coffee: coffee
noun mustard: mustard
noun sugar: sugar
noun tuna: tuna
noun jelly: jelly
noun cracker: cracker
noun colour: colour color
noun shape: shape solid
noun hand: hand
noun side: side half
noun edge: edge
noun end: end
noun wall: wall
noun floor: floor ground
noun air: air
noun counter: counter worktop
noun chair: chair
noun sofa: sofa couch
noun bed: bed
noun bag: bag sack
noun basket: basket
noun key: key
noun pen: pen pencil
noun apple: apple
noun banana: banana
noun orange-fruit: oranges
noun sink: sink
noun kettle: kettle
noun toaster: toaster
noun shirt: shirt
noun hat: hat
noun toy: toy
noun car: car
noun screw: screw
noun hammer: hammer
noun spatula: spatula
noun vase: vase
noun flower: flower
noun basin: basin
noun hood: hood
noun mark: mark
noun number: number digit
noun order: sequence
noun space: space
noun dial: dial
noun screen: screen
noun keyboard: keyboard
noun opening: opening
verb open [open unscrew]: open unlatch unlock uncover
verb close [close]: close shut
verb unscrew [unscrew turn]: unscrew untwist
verb take [pick take_out take_from_shelf extract unhang unscrew]: take grab grasp grip get fetch collect seize retrieve pick obtain gather clutch
verb hold [pick lift]: hold
verb find [pick take_out reach]: find locate search look identify select choose
verb remove [unscrew extract take_out take_from_shelf unhang pick lift]: disconnect remove extract withdraw eject unplug detach unload unpack unhook free
verb empty []: empty
verb lift [lift pick open take_out extract unhang]: lift raise hoist elevate
verb lower [place set_down lay drop close open put_in insert stack hang put_on_shelf]: lower
verb put [place put_in put_on_shelf set_down lay drop stack insert hang]: put place lay set rest deposit store stow leave return deliver transfer move bring carry tuck load pack position arrange tidy replace relocate shift dock shelve bin seat post stick stash park slip pop
verb serve []: serve
verb setup []: setup
verb drop [drop put_in insert hang]: drop release throw toss fall falls
verb insert [insert put_in place drop hang stack]: insert plug fit connect slot-in feed attach
verb stack [stack place put_in insert]: nest stack pile heap
verb build [stack place]: build construct assemble create form make
verb hang [hang]: hang suspend dangle hook
verb press [press press_with push]: press depress tap click hit
verb pull [open close take_out extract drag pick]: pull draw tug yank
verb slide [open close insert push drag put_in put_on_shelf unhang hang place]: slide
verb swing [open close]: swing fold tilt flip
verb push [push close press press_with insert put_in]: push shove nudge
verb drag [drag]: drag sweep
verb turn [turn unscrew]: turn rotate twist spin
verb switch []: switch activate deactivate
verb point [point]: point direct
verb reach [reach]: reach touch approach
verb sort [put_in place set_down]: sort separate organise organize
verb weigh [place set_down]: weigh measure
verb pour []: pour
verb cut []: cut slice chop
verb clean []: clean wipe wash scrub
verb cook []: cook bake boil fry heat
verb break []: break smash crush
verb shake []: shake stir
verb throw []: hurl
verb eat []: eat drink taste
verb clear [pick place put_in drop]: clear
verb stand [place set_down put_on_shelf put_in insert]: stand
verb belong []: belong go come goes end
verb complete []: complete finish accomplish achieve perform execute
verb lie []: lie sit
verb contain []: contain
verb locate []: located
verb mark []: marked labelled labeled numbered
verb show []: show say bear
verb colour []: coloured colored painted
verb take-care []: care
)";

const char* const kPhraseText = R"(
get rid of=remove
set the table=serve the table
lay the table=serve the table
take hold of=hold
get hold of=hold
keep hold of=hold
let go=drop
let go of=drop
memory stick=usb stick
flash drive=usb stick
thumb drive=usb stick
usb drive=usb stick
pick up=take
picks up=take
picking up=take
set up=setup
a quarter=quarter
on top of=onto
in front of=before-thing
next to=beside
close to=near
out of=outof
away from=outof
one of=1 of
right side up=upright
face down=facedown
upside down=upsidedown
at once=quickly
dark blue=navy
dark-blue=navy
dark red=maroon
dark-red=maroon
followed by=then
go on to=then
after that=then
after it=then
after this=then
after both=then
after them=then
after which=then
one on top of another=up
one on top of the other=up
on top of each other=up
on top of one another=up
one upon another=up
bring it up=lift it
bring them up=lift them
bring up=lift
put up=build
where it is=there
where they are=there
where it stands=there
all the way=fully
i'd like=i want
would like=want
right now=now
make sure=ensure
making sure=ensure
a little=slightly
in order to=to
any colour but=except
every colour but=except
anything but=except
all but=except
side by side=sidebyside
at the same time=simultaneously
as well=also
any more=anymore
no longer=not longer
would you mind=please
do you mind=please
)";

}  // namespace stampede
