"use strict";(()=>{var Wn=class extends Error{constructor(t,i){super(i.message);this.status=t;this.problem=i}status;problem},Qi=n=>new Promise(e=>setTimeout(e,n));async function kr(n){let e=await n.json().catch(()=>null);return new Wn(n.status,e?.error??{message:`${n.status} ${n.statusText}`,advice:null})}async function Fs(n){let e=await fetch(n,{signal:AbortSignal.timeout(3e4)});if(!e.ok)throw await kr(e);return await e.json()}async function ah(n){let e=await fetch(n,{signal:AbortSignal.timeout(3e4)});if(!e.ok)throw await kr(e);return e.text()}async function oh(n){let e=await fetch("/api/do",{method:"POST",headers:{"content-type":"application/json"},body:JSON.stringify(n),signal:AbortSignal.timeout(3e4)});if(!e.ok)throw await kr(e)}async function lh(n){let e=await fetch("/api/image",{method:"POST",body:n,signal:AbortSignal.timeout(3e4)});if(!e.ok)throw await kr(e)}async function ch(n,e){let t=null,i=300;for(;;)try{let s=await Fs(t===null?"/api/state":`/api/state?after=${t}`);i!==300&&e(null),i=300,t=s.version,n(s)}catch(s){e(s),t=null,await Qi(i),i=Math.min(2*i,3e3)}}var qf=["language","muted","joints"],hh="handeye-session";function Kf(){try{return JSON.parse(localStorage.getItem(hh)??"{}")}catch{return{}}}function Yf(n){try{localStorage.setItem(hh,JSON.stringify(Object.fromEntries(qf.map(e=>[e,n[e]]))))}catch{}}function uh(n){let e={state:null,choices:{language:null,muted:!1,selected:null,large:"picture",joints:!1,typed:"",by:"views",...Kf()},lostSince:null,signedOut:!1,refused:null,redraw:n,async send(t){try{return await oh(t),e.refused=null,n(),!0}catch(i){return e.refused=i instanceof Wn?i.problem:{code:"no-connection",message:"",advice:null},n(),!1}},choose(t){Object.assign(e.choices,t),e.state&&(e.state.by=e.choices.by),Yf(e.choices),n()}};return e}function Us(n){return n.state?.captures?.find(e=>e.id===n.choices.selected)??null}var zt=({step:n,by:e})=>n==="capture"||n==="verify"&&e!=="touches",Xn=({step:n,by:e})=>n==="touch"||n==="verify"&&e==="touches",Or=n=>n.step==="verify"&&n.by==="touches"?n.verify?.say_touch??n.say:n.say,Fi=n=>n.step==="verify"?n.verify?.touch:n.touch,vn=({used:n,reason:e})=>n===!1&&!!e,Ui=({placement:n,lying:e})=>!!n&&(e??"placed")==="placed";var Zf=2,$f=1,Jf=3;function ks(n){let e=n.next?.off;return typeof e?.mm!="number"||n.robot?.typed?null:e.mm<Zf&&(e.deg??0)<$f}var jf="/api/report",Qf=()=>{window.open(jf,"_blank","noopener")};function dt(n,e,t,i=!0){return{label:e,enabled:i,run:()=>{n.send(t)}}}function Oi(n){return n.progress?.enough===!0&&(n.progress.verdict??"accepted")==="accepted"}var In=null,ep=2e4,ph=n=>[n.captures,n.deleted,n.refused,n.verify?.views,n.touch?.placements,n.verify?.touch?.placements].reduce((e,t)=>e+(t?.length??0),0),mh=({problem:n})=>n&&n.code!=="image-late"?n.message:"";function Br(n){if(!In)return!1;n.taking&&(In.at=performance.now());let e=mh(n);return(In.outcomes!==ph(n)||e!==""&&e!==In.problem||performance.now()-In.at>ep)&&(In=null),In!==null}function Os(n){return!n.taking&&!n.virtual_cell?.driving&&!Br(n)}async function ui(n){let e=n.choices.typed.trim();return!n.state?.robot?.typed||!e?!0:await n.send({do:"pose",text:e})?(n.choose({typed:""}),!0):!1}async function Bs(n){await ui(n)&&await gh(n,"take")}async function gh(n,e){!n.state||n.state.taking||(In={outcomes:ph(n.state),problem:mh(n.state),at:performance.now()},await n.send({do:e})||(In=null))}function zr(n){In=null,n.send({do:"cancel"})}function es(n,e){let t=e.robot?.typed||e.camera?.single;return{label:e.taking?t?"waiting_for_both":"waiting_for_rest":e.step==="verify"?"take_view":"take",enabled:Os(e),run:()=>{Bs(n)}}}function tp(n,e){return e.virtual_cell?.driving?dt(n,"driving",{do:"cancel"},!1):e.taking?es(n,e):e.assessing||Br(e)?dt(n,"assessing_now",{do:"cancel"},!1):Oi(e)?dt(n,"finish",{do:"finish"}):e.virtual_cell&&ks(e)===!1?dt(n,"drive",{do:"drive",to:"next"}):es(n,e)}var np=3;function ip(n,e){let t=e.verify?.views?.length??0;return e.virtual_cell?.driving?dt(n,"driving",{do:"cancel"},!1):e.taking?es(n,e):e.assessing||Br(e)?dt(n,"assessing_now",{do:"cancel"},!1):t>=np&&e.verify?.agrees===!0?dt(n,"finish",{do:"finish"}):e.virtual_cell&&ks(e)===!1?dt(n,"drive",{do:"drive",to:"next"}):es(n,e)}var sp=6,rp=4;function nl(n,e){return e.taking?{label:"waiting_for_board",enabled:!1,run:()=>zr(n)}:e.virtual_cell&&Fi(e)?.lying!=="new"?dt(n,"lay_board",{do:"drive",to:"placement"}):{label:"place",enabled:!Br(e),run:()=>{gh(n,"place")}}}function dh(n,e){let t=Fi(e),i=t?.touches?.length??0,s=e.step==="verify";if(e.virtual_cell?.driving)return dt(n,"driving",{do:"cancel"},!1);if(e.assessing)return dt(n,"assessing_now",{do:"cancel"},!1);if(!t?.tip_mm)return dt(n,"touch_it",{do:"touch"},!1);let r=s?i>=rp&&e.verify?.agrees===!0:i>=sp;return s&&r&&!e.taking?dt(n,"finish",{do:"finish"}):t.lays&&(e.taking||!Ui(t))?nl(n,e):r?dt(n,"finish",{do:"finish"}):e.virtual_cell&&t.at_corner!==!0?dt(n,"drive_tip",{do:"drive",to:"touch"}):!e.robot?.typed&&e.robot?.stands===!1?{label:"waiting_for_rest",enabled:!1,run:()=>{}}:{label:"touch_it",enabled:!0,run:()=>{ap(n)}}}async function ap(n){await ui(n)&&await n.send({do:"touch"})}function ki(n,e){let t=op(n,e);return n.lostSince===null&&n.state?t:{...t,enabled:!1}}function op(n,e){switch(e.step){case"capture":return tp(n,e);case"touch":return dh(n,e);case"verify":return Xn(e)?dh(n,e):ip(n,e);case"result":return e.result?{label:"open_report",enabled:!0,icon:"page",run:Qf}:dt(n,"back_to_captures",{do:"go",step:"capture"});case"robot":return{label:"confirm",enabled:fh(e)||n.choices.typed.trim()!=="",run:()=>{lp(n)}};default:return dt(n,"confirm",{do:"confirm",step:e.step??"cell"},fh(e))}}var fh=n=>n.steps?.find(({name:e})=>e===n.step)?.proven!==!1;async function lp(n){await ui(n)&&await n.send({do:"confirm",step:"robot"})}function _h(n,e){let t=e.taking?[{label:"cancel",enabled:!0,run:()=>zr(n)}]:[],i=zt(e)&&(["take","take_view"].includes(ki(n,e).label)||e.taking);switch(e.step){case"capture":return[...t,...i?[]:[es(n,e)],...Oi(e)&&e.touch?[dt(n,"go_touch",{do:"go",step:"touch"})]:[],...Oi(e)&&e.verify?[dt(n,"go_verify",{do:"go",step:"verify"})]:[],{...dt(n,"automatic",{do:"automatic",on:!e.automatic}),on:e.automatic===!0}];case"touch":return[...t,...ki(n,e).label==="finish"?[]:[dt(n,"finish",{do:"finish"})],dt(n,"back_to_captures",{do:"go",step:"capture"})];case"verify":return[...t,...i||Xn(e)?[]:[es(n,e)],...ki(n,e).label==="finish"?[]:[dt(n,"finish",{do:"finish"})],dt(n,"back_to_captures",{do:"go",step:"capture"})];case"result":return e.result?[dt(n,"back_to_captures",{do:"go",step:"capture"})]:[];default:return t}}function bh(n){return(n.captures?.filter(e=>!vn(e)).length??0)>=Jf}function qn(n){return n.cell?.is_virtual?"fixed_virtual":null}function xh(n){n.state?.virtual_cell?n.send({do:"drive",to:"next"}):il(n)}function il(n){n.send({do:"skip",why:"cannot reach"})}function vh(n){let e=Us(n);e&&n.send({do:"delete",id:e.id})}function sl(n,e){let t=n.state?.captures??[];if(!t.length)return;let i=t.findIndex(r=>r.id===n.choices.selected),s=i<0?t.length-1:Math.min(t.length-1,Math.max(0,i+e));n.choose({selected:t[s]?.id??null})}function Gr(n,e){let t=n.state?.steps?.find(({name:i})=>i===e);t&&t.state!=="locked"&&n.send({do:"go",step:e})}function R(n,e={},...t){return yh(document.createElement(n),e,t)}function _t(n,e={},...t){return yh(document.createElementNS("http://www.w3.org/2000/svg",n),e,t)}function yh(n,e,t){for(let[i,s]of Object.entries(e))typeof s=="function"?n.addEventListener(i,s):Pe(n,i,s);for(let i of t)i!==null&&n.append(i);return n}function Pe(n,e,t){if(t===!1||t===null||t===void 0){n.hasAttribute(e)&&n.removeAttribute(e);return}let i=t===!0?"":String(t);n.getAttribute(e)!==i&&n.setAttribute(e,i)}function Ee(n,e){let t=e??"";n.textContent!==t&&(n.textContent=t)}function fe(n,e){n instanceof HTMLElement?n.hidden===e&&(n.hidden=!e):Pe(n,"display",e?null:"none")}function Ne(n,e,t){n.classList.contains(e)!==t&&n.classList.toggle(e,t)}function zs(n,e){let t=`${Math.round(Math.min(100,Math.max(0,e))*10)/10}%`;n.style.width!==t&&(n.style.width=t)}function Dn(n,e){document.activeElement!==n&&n.value!==e&&(n.value=e)}function ut(n,e,t){let i=new Map;return s=>{let r=new Set(s.map(e));for(let[o,c]of i)r.has(o)||(c.element.remove(),i.delete(o));let a=n.firstElementChild;for(let o of s){let c=e(o),l=i.get(c);l||i.set(c,l=t(o)),l.element===a?a=a.nextElementSibling:n.insertBefore(l.element,a),l.update(o)}}}var rl={check:"M5 12.5 10 17.5 19 7",lock:"M7 11V8a5 5 0 0 1 10 0v3M6 11h12v9H6z",warning:"M12 3.5 22 20.5H2zM12 10v4.5M12 17.2v.6",cross:"M6 6l12 12M18 6 6 18",bin:"M5 7h14M10 7V4.5h4V7M7 7l1 13h8l1-13",again:"M19 12a7 7 0 1 1-2.2-5.1M19 4v5h-5",undo:"M9 5 4 10l5 5M4 10h10a5.5 5.5 0 0 1 0 11h-3",sound:"M4 9.5v5h3.5L12 19V5L7.5 9.5zM15.5 9a4 4 0 0 1 0 6M18 6.5a8 8 0 0 1 0 11",mute:"M4 9.5v5h3.5L12 19V5L7.5 9.5zM16 10l5 5M21 10l-5 5",keys:"M3 7h18v11H3zM7 11h.5M11 11h.5M15 11h.5M8 15h8",swap:"M4 9h13l-4-4M20 15H7l4 4",copy:"M9 9h11v11H9zM5 15H4V4h11v1",page:"M6 3h8l5 5v13H6zM14 3v5h5M9 13h7M9 17h7",skip:"M5 5l8 7-8 7zM17 5v14",back:"M10 5l-7 7 7 7M3 12h18",down:"M12 4v12M6 11l6 6 6-6M5 21h14"};function Pt(n){return _t("svg",{viewBox:"0 0 24 24",class:"icon","aria-hidden":"true",focusable:"false"},_t("path",{d:rl[n]}))}function on(n,e){let t=n.firstElementChild;t&&t.getAttribute("d")!==rl[e]&&t.setAttribute("d",rl[e])}var wh={steps:["Steps of the calibration","Schritte der Kalibrierung"],step_cell:["Cell","Zelle"],step_camera:["Camera","Kamera"],step_robot:["Robot","Roboter"],step_board:["Board","Tafel"],step_capture:["Captures","Aufnahmen"],step_touch:["Touches","Antasten"],step_verify:["Verification","Prüfung"],step_result:["Result","Ergebnis"],state_done:["(done)","(erledigt)"],state_now:["(now)","(jetzt)"],state_open:["(open)","(offen)"],state_locked:["(not yet)","(noch nicht)"],sound_off:["Switch the sounds off","Töne ausschalten"],sound_on:["Switch the sounds on","Töne einschalten"],in_german:["DE: Deutsch","DE: Deutsch"],in_english:["EN: English","EN: English"],keys:["Keys","Tasten"],stage:["Image and cell","Bild und Zelle"],side:["Details of the step","Einzelheiten des Schritts"],close:["Close","Schließen"],less:["Less","Weniger"],more:["More","Mehr"],confirm:["This is right: go on","Das stimmt: weiter"],take:["Take a capture","Aufnehmen"],waiting_for_both:["Waiting for pose and image","Warte auf Pose und Bild"],assessing_now:["Being assessed","Wird ausgewertet"],waiting_for_rest:["Waiting for standstill","Warte auf Stillstand"],driving:["The robot drives","Der Roboter fährt"],drive:["Drive to this view","Zur Ansicht fahren"],finish:["Finish: calibrate","Fertig: kalibrieren"],finish_now:["Finish with these captures","Mit diesen Aufnahmen abschließen"],back_to_captures:["Back to the captures","Zurück zu den Aufnahmen"],open_report:["Open the report","Bericht öffnen"],cancel:["Cancel","Abbrechen"],automatic:["Automatic","Automatisch"],connecting:["Connecting to the session.","Verbinde mit der Sitzung."],lost:["No connection to the session.","Keine Verbindung zur Sitzung."],lost_advice:["What you see is old. The page connects again by itself; if it does not, check that `handeye session` still runs.","Was hier steht, ist alt. Die Seite verbindet sich von selbst wieder; wenn nicht: Läuft `handeye session` noch?"],signed_out:["This browser is not signed in.","Dieser Browser ist nicht angemeldet."],signed_out_advice:["Open the address that `handeye session` printed, with its token.","Öffnen Sie die Adresse mit dem Schlüssel, die `handeye session` ausgegeben hat."],not_sent:["The command did not reach the session.","Der Befehl kam nicht bei der Sitzung an."],capture_refused:["No capture was taken:","Nicht aufgenommen:"],rejected_so_far:["The result of the captures so far is rejected.","Das Ergebnis der bisherigen Aufnahmen ist abgelehnt."],live_picture:["Live image with the corners that were found and the place of the board at the next view","Livebild mit den gefundenen Ecken und dem Platz der Tafel bei der nächsten Ansicht"],captured_picture:["Image of the capture with the residuals of its corners","Bild der Aufnahme mit den Residuen ihrer Ecken"],live:["Live","Live"],no_camera:["The camera is not connected","Die Kamera ist nicht verbunden"],no_picture:["No image yet","Noch kein Bild"],picture_number:["Image {number}","Bild {number}"],picture_old:["The image is {seconds} s old","Das Bild ist {seconds} s alt"],back_to_live:["Live image","Livebild"],capture_id:["Capture {id}","Aufnahme {id}"],not_used:["not used","nicht verwendet"],view_number:["View {number}","Ansicht {number}"],rotate_by:["rotate by {deg}°","um {deg}° drehen"],nearer:["nearer","näher"],farther:["farther","weiter weg"],arrows_longer:["Residuals {factor} times longer; {px} px RMS","Residuen {factor}-fach verlängert; {px} px RMS"],cell_3d:["The cell in 3D: robot, camera, board, captures and next view. The arrow keys rotate it.","Die Zelle in 3D: Roboter, Kamera, Tafel, Aufnahmen und nächste Ansicht. Die Pfeiltasten drehen sie."],no_3d:["This browser cannot show the cell in 3D.","Dieser Browser kann die Zelle nicht in 3D zeigen."],swap:["Swap image and cell","Bild und Zelle tauschen"],next_view:["View {number}","Ansicht {number}"],robot_now:["The robot's pose","Pose des Roboters"],at_view:["The robot is there","Der Roboter ist da"],away:["{mm} mm and {deg}° away","noch {mm} mm und {deg}°"],now_at:["now {value}","jetzt {value}"],gain:["Error {before} → {after} mm","Fehler {before} → {after} mm"],joints:["Joints","Gelenke"],other_view:["Another view","Andere Ansicht"],typed_pose:["Pose from the pendant","Pose vom Bediengerät"],accuracy:["Predicted position error (95 %)","Vorhergesagter Positionsfehler (95 %)"],of_tolerance:["{tolerance} mm tolerated","{tolerance} mm erlaubt"],findings_below:["Findings that change the answer: {count}","Befunde, die die Antwort ändern: {count}"],error_label:["{error} mm; {tolerance} mm are tolerated","{error} mm; {tolerance} mm sind erlaubt"],assessing:["computing","rechnet"],no_progress:["The error is known after a few captures.","Nach einigen Aufnahmen ist der Fehler bekannt."],verdict_rejected:["Rejected","Abgelehnt"],verdict_undetermined:["Not determined yet: more views are needed.","Noch nicht bestimmt: Weitere Ansichten fehlen."],verdict_enough:["Accurate enough","Genau genug"],verdict_more:["Not accurate enough yet","Noch nicht genau genug"],history_label:["Error after each capture: {points}","Fehler nach jeder Aufnahme: {points}"],captures_count:["{count} captures","{count} Aufnahmen"],six_directions:["Standard deviation per direction","Standardabweichung je Richtung"],about_axis:["about {axis}","um {axis}"],unknown_direction:["{direction}: not determined","{direction}: nicht bestimmt"],undetermined_list:["Undetermined: {list}","Nicht bestimmt: {list}"],truth_error:["Virtual cell: the true error is {mm} mm","Virtuelle Zelle: Der wahre Fehler ist {mm} mm"],captures:["Captures","Aufnahmen"],no_captures:["None yet.","Noch keine."],no_residual:["no residual yet","noch kein Residuum"],delete:["Delete","Löschen"],retake:["Retake","Wiederholen"],restore:["Restore","Zurückholen"],undo:["Undo","Rückgängig"],deleted_id:["{id} is deleted","{id} ist gelöscht"],findings:["Findings","Befunde"],remarks:["Remarks","Hinweise"],refused:["Refused","Zurückgewiesen"],where_is_camera:["Where is the camera?","Wo ist die Kamera?"],eye_in_hand:["On the flange","Am Flansch"],eye_in_hand_what:["The board lies still (eye-in-hand).","Die Tafel liegt still (eye-in-hand)."],eye_to_hand:["Beside the robot","Neben dem Roboter"],eye_to_hand_what:["The board is on the flange (eye-to-hand).","Die Tafel ist am Flansch (eye-to-hand)."],fixed_virtual:["A virtual cell has its own setup, camera and board.","Eine virtuelle Zelle hat Aufbau, Kamera und Tafel schon."],read_again:["The captures are read again with what is changed here. For another camera, board or robot begin a session in a new folder.","Die Aufnahmen werden mit dem, was hier geändert wird, neu gelesen. Für eine andere Kamera, Tafel oder einen anderen Roboter eine Sitzung in einem neuen Ordner beginnen."],how_accurate:["How accurate must it be?","Wie genau muss es werden?"],tolerance:["Position error that your work tolerates","Positionsfehler, den die Arbeit erlaubt"],tolerance_what:["The session is done when 95 % of the points in the workspace are within this error.","Die Sitzung ist fertig, wenn 95 % der Punkte im Arbeitsraum innerhalb dieses Fehlers liegen."],camera:["Camera","Kamera"],pictures:["Images","Bilder"],poses:["Poses","Posen"],streaming:["streaming","laufend"],one_by_one:["one by one","einzeln"],from_pendant:["typed from the pendant","vom Bediengerät abgetippt"],newest:["Last one","Zuletzt"],size:["Image","Bild"],age:["Age","Alter"],rest:["Standstill","Stillstand"],delay:["Delay","Verzögerung"],save_picture:["Take an image with the camera's own program: it appears here as soon as it is saved.","Mit dem Programm der Kamera ein Bild aufnehmen: Es erscheint hier, sobald es gespeichert ist."],not_known_yet:["not known yet","noch nicht bekannt"],intrinsics:["Intrinsics","Intrinsik"],intrinsics_unknown:["Not known","Nicht bekannt"],intrinsics_unknown_what:["They are calibrated from the captures.","Sie werden aus den Aufnahmen kalibriert."],intrinsics_known:["Known","Bekannt"],intrinsics_known_what:["They are tested against the captures.","Sie werden an den Aufnahmen geprüft."],fx:["fx","fx"],fy:["fy","fy"],cx:["cx","cx"],cy:["cy","cy"],distortion_model:["Distortion","Verzeichnung"],no_distortion:["None","Keine"],brown_conrady:["OpenCV: k1 k2 p1 p2 k3 …","OpenCV: k1 k2 p1 p2 k3 …"],kannala_brandt:["OpenCV fisheye: k1 k2 k3 k4","OpenCV-Fischauge: k1 k2 k3 k4"],distortion:["Distortion coefficients","Koeffizienten der Verzeichnung"],intrinsics_hint:["As in OpenCV: the centre of the top left pixel is (0, 0).","Wie in OpenCV: Die Mitte des Pixels oben links ist (0, 0)."],robot:["Robot","Roboter"],no_robot:["none has come","es kommt keine"],notation:["Notation of poses","Schreibweise der Posen"],flange_hint:["The pose must be that of the flange in the base: no tool, no user frame.","Die Pose muss die des Flanschs in der Basis sein: kein Werkzeug, kein Benutzerkoordinatensystem."],type_pose:["Type a pose","Pose eintippen"],use_pose:["Use this pose","Diese Pose verwenden"],tip:["Tip of the tool","Werkzeugspitze"],tip_hint:["Where the tip is in the flange, as the tool of the robot's controller has it.","Wo die Spitze im Flansch ist, wie das Werkzeug in der Robotersteuerung."],tip_x:["x","x"],tip_y:["y","y"],tip_z:["z","z"],touch_next:["Corner to touch","Anzutastende Ecke"],touch_why:["The corner is where squares meet; of circles, a centre. Touches are a second instrument: they show errors that camera and arm share.","Die Ecke ist, wo Felder sich treffen; bei Kreisen eine Mitte. Das Antasten ist ein zweites Messmittel: Es zeigt Fehler, die Kamera und Arm gemeinsam haben."],touches:["Touches","Angetastet"],corner_number:["Corner {number}","Ecke {number}"],touch_it:["The tip is at the corner","Die Spitze ist an der Ecke"],placements:["Boards laid down","Hingelegte Tafeln"],placement_what:["The robot cannot touch the board that it carries. Lay that one, once all captures are taken, or another of the same kind into the view, so that the tool reaches it; take its image; then touch its corners, and do not move it. Three of them at two heights tell most.","Die Tafel, die der Roboter trägt, kann er nicht antasten. Diese, wenn alle Aufnahmen gemacht sind, oder eine gleiche so ins Bild legen, dass das Werkzeug hinkommt; ihr Bild aufnehmen; dann ihre Ecken antasten und sie nicht bewegen. Drei davon in zwei Höhen sagen am meisten."],placement_touches:["{id}: {count} touched","{id}: {count} angetastet"],placed_corner:["{id}, corner {number}","{id}, Ecke {number}"],place:["Take the board's image","Bild der Tafel aufnehmen"],place_again:["It lies elsewhere now: take its image","Sie liegt jetzt woanders: Bild aufnehmen"],lay_board:["Lay a board into the view","Tafel ins Bild legen"],waiting_for_board:["Waiting for the board's image","Warte auf das Bild der Tafel"],drive_tip:["Bring the tip there","Spitze hinführen"],go_touch:["Touch corners","Ecken antasten"],image:["Image","Bild"],upload_hint:["Hand over an image of each pose: a file of the camera, or one of this browser's camera with its autofocus switched off. Images that are saved into a watched folder (--images-from) come by themselves.","Zu jeder Pose ein Bild übergeben: eine Datei der Kamera, oder eines von der Kamera dieses Browsers bei abgeschaltetem Autofokus. Bilder, die in einen beobachteten Ordner gespeichert werden (--images-from), kommen von selbst."],choose_image:["Choose a file","Datei wählen"],browser_camera:["Use this browser's camera","Kamera dieses Browsers"],take_image:["Take the image","Bild aufnehmen"],camera_off:["Switch the camera off","Kamera ausschalten"],image_not_sent:["The image was not sent. Try again.","Das Bild wurde nicht übertragen. Noch einmal versuchen."],no_browser_camera:["This browser gives no camera to the page. It does so to pages of this machine (127.0.0.1), if the camera is not in use and you allow it.","Dieser Browser gibt der Seite keine Kamera. Er tut es für Seiten dieses Rechners (127.0.0.1), wenn die Kamera frei ist und es erlaubt wird."],verification:["Verification","Prüfung"],verification_views:["Verification views","Prüfansichten"],by_views:["By views","Durch Ansichten"],by_views_what:["The calibration is not made with them. It should predict them as well as its own captures, and best where the robot will work.","Die Kalibrierung entsteht nicht aus ihnen. Sie soll sie so gut vorhersagen wie ihre eigenen Aufnahmen, vor allem dort, wo der Roboter arbeiten wird."],by_touches:["By touches","Durch Antasten"],by_touches_what:["The tip of the tool touches corners of the board: does the robot find what the camera measures?","Die Werkzeugspitze tastet Ecken der Tafel an: Findet der Roboter, was die Kamera misst?"],verify_touches_why:["The corner is where squares meet; of circles, a centre. The calibration is not made with these touches.","Die Ecke ist, wo Felder sich treffen; bei Kreisen eine Mitte. Die Kalibrierung entsteht nicht aus diesen Antastungen."],verified_yes:["They agree with the calibration.","Sie passen zur Kalibrierung."],verified_no:["They contradict the calibration.","Sie widersprechen der Kalibrierung."],verified_by_views:["Views: {rms} mm (RMS) from the predictions; {expected} mm are expected.","Ansichten: {rms} mm (RMS) von den Vorhersagen; {expected} mm sind zu erwarten."],verified_by_touches:["Touches: {rms} mm (RMS) from the predictions; {expected} mm are expected.","Antastungen: {rms} mm (RMS) von den Vorhersagen; {expected} mm sind zu erwarten."],take_view:["Take the view","Ansicht aufnehmen"],go_verify:["Verify the result","Ergebnis prüfen"],typed_otherwise:["Typed in another notation?","In anderer Schreibweise getippt?"],typed_otherwise_hint:["The numbers that were typed stay as they are, and are read as those of the other notation.","Die getippten Zahlen bleiben, wie sie sind, und werden in der anderen Schreibweise gelesen."],typed_in:["They were typed in","Getippt wurden sie in"],reread:["Read them again","Neu lesen"],jog:["Move the virtual robot","Virtuellen Roboter bewegen"],jog_what:["In the camera's axes: 40 mm, or 10°.","In den Achsen der Kamera: 40 mm oder 10°."],in_picture:["In the image","Im Bild"],not_found_yet:["The board is not found.","Die Tafel wird nicht gefunden."],board:["Board","Tafel"],target_kind:["Kind","Art"],measure_board:["Measure the print over many squares: an error of 1 % there is an error of 1 % of the distance.","Den Druck über viele Felder messen: 1 % Fehler dort ist 1 % Fehler der Entfernung."],checkerboard:["Checkerboard","Schachbrett"],charuco:["ChArUco","ChArUco"],aprilgrid:["AprilTag grid (Kalibr)","AprilTag-Gitter (Kalibr)"],tag_grid:["Grid of markers (OpenCV)","Markergitter (OpenCV)"],tag:["One marker","Einzelner Marker"],circle_grid:["Grid of circles","Kreisgitter"],asymmetric_circle_grid:["Asymmetric grid of circles","Asymmetrisches Kreisgitter"],modified_circle_grid:["Grid with one larger circle","Gitter mit einem größeren Kreis"],sphere:["Ball (3D scans)","Kugel (3D-Scans)"],inner_columns:["Inner corners along x","Innere Ecken entlang x"],inner_rows:["Inner corners along y","Innere Ecken entlang y"],squares_x:["Squares along x","Felder entlang x"],squares_y:["Squares along y","Felder entlang y"],square:["Side of a square","Seite eines Felds"],marker:["Side of a marker","Seite eines Markers"],tags_x:["Markers along x","Marker entlang x"],tags_y:["Markers along y","Marker entlang y"],tag_size:["Side of a marker","Seite eines Markers"],tag_id:["Number of the marker","Nummer des Markers"],gap:["Gap between markers","Lücke zwischen Markern"],spacing:["Gap / side of a marker","Lücke / Seite eines Markers"],family:["Family","Familie"],dictionary:["Dictionary","Wörterbuch"],circles_x:["Circles along x","Kreise entlang x"],circles_y:["Circles along y","Kreise entlang y"],pitch:["Distance of centres","Abstand der Mitten"],row_pitch:["Distance of rows","Abstand der Reihen"],diameter:["Diameter","Durchmesser"],result_accepted:["Accepted","Angenommen"],result_rejected:["The result is rejected.","Das Ergebnis ist abgelehnt."],result_undetermined:["The result is not determined.","Das Ergebnis ist nicht bestimmt."],no_result:["No result yet","Noch kein Ergebnis"],exports:["Exports","Exporte"],more_formats:["More formats","Mehr Formate"],fewer_formats:["Fewer formats","Weniger Formate"],save:["Save","Sichern"],binary:["A binary file: save it.","Eine Binärdatei: bitte sichern."],accepted_by:["{error} mm for 95 % of the points in the workspace, from {count} captures; {tolerance} mm are tolerated.","{error} mm für 95 % der Punkte im Arbeitsraum, aus {count} Aufnahmen; {tolerance} mm sind erlaubt."],no_result_what:["Take captures, then finish.","Erst aufnehmen, dann abschließen."],files:["Files","Dateien"],copy:["Copy","Kopieren"],copied:["Copied","Kopiert"],not_copied:["Select it and copy by hand","Bitte von Hand kopieren"],key_primary:["The primary action","Die wichtigste Aktion"],key_next:["Drive to the next view, or ask for another one","Zur nächsten Ansicht fahren oder eine andere verlangen"],key_take:["Take a capture","Aufnehmen"],key_automatic:["Automatic on or off","Automatik ein oder aus"],key_select:["Select a capture","Aufnahme wählen"],key_delete:["Delete the selected capture","Gewählte Aufnahme löschen"],key_retake:["Retake the selected capture","Gewählte Aufnahme wiederholen"],key_undo:["Undo","Rückgängig"],key_steps:["Go to a step","Zu einem Schritt gehen"],key_swap:["Swap image and cell","Bild und Zelle tauschen"],key_mute:["Sounds on or off","Töne ein oder aus"],key_escape:["Back to the live image; cancel","Zurück zum Livebild; abbrechen"],key_help:["Show these keys","Diese Tasten zeigen"]},Sh=[["written to {folder~}","Geschrieben nach {folder~}"],["no result is written yet","Noch kein Ergebnis geschrieben"],["the robot carries the camera (eye-in-hand)","Der Roboter trägt die Kamera (eye-in-hand)"],["the camera stands beside the robot, which carries the board (eye-to-hand)","Die Kamera steht neben dem Roboter, der die Tafel trägt (eye-to-hand)"],["{mm} mm are tolerated (95 %)","{mm} mm sind erlaubt (95 %)"],["{mm} mm (95 %)","{mm} mm (95 %)"],["no image has come yet","Noch kein Bild gekommen"],["no image for {s} s","Seit {s} s kein Bild"],["the images have {w} x {h} pixels, the intrinsics are for {wide} x {high}","Die Bilder haben {w} x {h} Pixel, die Intrinsik gilt für {wide} x {high}"],["images of {w} x {h} pixels","Bilder mit {w} x {h} Pixeln"],["intrinsics are given","Die Intrinsik ist gegeben"],["intrinsics are calibrated from the views","Die Intrinsik wird aus den Ansichten kalibriert"],["type the pose that the pendant shows","Die Pose eintippen, die das Bediengerät zeigt"],["the robot has not sent a pose yet","Der Roboter hat noch keine Pose gesendet"],["no pose for {s} s","Seit {s} s keine Pose"],["the flange is at x {x}, y {y}, z {z} mm","Der Flansch ist bei x {x}, y {y}, z {z} mm"],["{far} m from the origin of the base, where arms are {least} to {most} m from it","{far} m vom Ursprung der Basis, bei Armen sind es {least} bis {most} m"],["are its lengths in another unit, or is this another notation?","Sind die Längen in einer anderen Einheit, oder ist dies eine andere Schreibweise?"],["{count} of {all} corners are found","{count} von {all} Ecken gefunden"],["{count} of {all} corners","{count} von {all} Ecken"],["the board is not found: {why*}","Die Tafel wird nicht gefunden: {why*}"],["1 capture","1 Aufnahme"],["{count} captures","{count} Aufnahmen"],["{mm} mm (95 %), of {limit} mm","{mm} mm (95 %) von {limit} mm"],["{mm} mm (95 %), {limit} mm are tolerated","{mm} mm (95 %), {limit} mm sind erlaubt"],["1 capture does not determine the answer yet","1 Aufnahme bestimmt das Ergebnis noch nicht"],["{count} captures do not determine the answer yet","{count} Aufnahmen bestimmen das Ergebnis noch nicht"],["corners are not touched in this cell","In dieser Zelle werden keine Ecken angetastet"],["no board was laid into the view to be touched; this step is optional","Keine Tafel zum Antasten ins Bild gelegt; dieser Schritt ist freiwillig"],["no corner was touched; this step is optional","Keine Ecke angetastet; dieser Schritt ist freiwillig"],["{count} touches, {rms} mm (RMS) from the answer","{count} Ecken angetastet, {rms} mm (RMS) vom Ergebnis"],["{count} touches","{count} Ecken angetastet"],["no view has been taken and no corner touched that verifies the captures","Noch keine Prüfansicht aufgenommen, und noch keine Ecke zur Prüfung angetastet"],["views and touches are being assessed","Ansichten und Antastungen werden ausgewertet"],["Is this your cell? Confirm who carries the camera, and which error your job tolerates.","Ist das Ihre Zelle? Bestätigen, wer die Kamera trägt und welchen Fehler die Arbeit erlaubt."],["Is this the image of your camera? Confirm it.","Ist das das Bild Ihrer Kamera? Bitte bestätigen."],["Is this where the flange is, in the notation of your robot? Confirm it.","Ist der Flansch dort, in der Schreibweise Ihres Roboters? Bitte bestätigen."],["Move the robot by hand: do the numbers move with it? Then confirm it.","Den Roboter von Hand bewegen: Bewegen sich die Zahlen mit? Dann bestätigen."],["The board is found. Confirm that its size is measured, not read off a drawing.","Die Tafel ist gefunden. Bestätigen, dass ihre Größe gemessen ist, nicht aus einer Zeichnung."],["The capture is being stored.","Die Aufnahme wird gespeichert."],["Hold still: {why*}.","Stillhalten: {why*}."],["waiting for a standstill","Warte auf Stillstand"],["The captures are being assessed.","Die Aufnahmen werden ausgewertet."],["Move the robot until the camera sees the whole board, then take the first capture.","Den Roboter bewegen, bis die Kamera die ganze Tafel sieht, dann die erste Aufnahme machen."],["Enough: {what*}","Genug: {what*}"],["the calibration states {mm} mm (95 %), and {limit} mm are tolerated","Die Kalibrierung gibt {mm} mm an (95 %), und {limit} mm sind erlaubt"],["Go on.","Weiter."],["The robot is at the view: take the capture.","Der Roboter ist an der Ansicht: jetzt aufnehmen."],["Drive to the next view: {reason*}.","Zur nächsten Ansicht fahren: {reason*}."],["No next view is found: {why*}.","Keine nächste Ansicht gefunden: {why*}."],["No next view is found.","Keine nächste Ansicht gefunden."],["Capture {id} is rejected as an outlier: {why*}","Aufnahme {id} ist als Ausreißer verworfen: {why*}"],["it does not fit to the others","Sie passt nicht zu den anderen"],["Take another one: it shows whether camera or board were moved.","Noch eine aufnehmen: Sie zeigt, ob Kamera oder Tafel bewegt wurden."],["If one was, begin a new session; if none was, delete this capture","Wenn ja, eine neue Sitzung beginnen; wenn nein, diese Aufnahme löschen"],["There is no result yet.","Noch kein Ergebnis."],["Accepted, but: {what*}: {mm} mm (95 %)","Angenommen, aber: {what*}: {mm} mm (95 %)"],["Accepted, but: {what*}","Angenommen, aber: {what*}"],["Accepted","Angenommen"],["Copy the transform, or open the report.","Die Transformation kopieren oder den Bericht öffnen."],["Rejected: {why*}. Do not use this transform.","Abgelehnt: {why*}. Diese Transformation nicht verwenden."],["Undetermined: {why*}. Take more captures.","Nicht bestimmt: {why*}. Mehr Aufnahmen machen."],["the captures do not determine the answer","Die Aufnahmen bestimmen das Ergebnis nicht"],["These captures do not fit together: {why*} Take another one wherever the whole board is seen: from {count} on the cause can be found.","Diese Aufnahmen passen nicht zusammen: {why*} Noch eine aufnehmen, wo die ganze Tafel zu sehen ist: Ab {count} lässt sich die Ursache finden."],["Something is wrong: {why*}","Etwas stimmt nicht: {why*}"],["Put it right before you go on.","Das in Ordnung bringen, bevor es weitergeht."],["See at the step Cell whether the camera is where it is said to be, and at the step Robot whether these are poses of the flange in the base, in this notation.","Im Schritt „Zelle“ prüfen, ob die Kamera dort ist, wo angegeben, und im Schritt „Roboter“, ob dies Posen des Flanschs in der Basis sind, in dieser Schreibweise."],["Choose the notation of the pendant at the step Robot, and enter the size of the board at the step Board.","Im Schritt „Roboter“ die Schreibweise des Bediengeräts wählen und im Schritt „Tafel“ die Größe der Tafel eingeben."],["Measure the board, and enter its size at the step Board.","Die Tafel messen und ihre Größe im Schritt „Tafel“ eingeben."],["Give other intrinsics at the step Camera, or have them calibrated there.","Im Schritt „Kamera“ eine andere Intrinsik angeben oder sie dort kalibrieren lassen."],["See that each pose is read when the robot stands, and take those captures again.","Darauf achten, dass jede Pose im Stillstand gelesen wird, und diese Aufnahmen wiederholen."],["Tilt the view by about 25 degrees about the image's x|, with the whole board in the image, and take a capture.","Die Ansicht um etwa 25 Grad um die x-Achse des Bilds neigen, mit der ganzen Tafel im Bild, und aufnehmen."],["Now tilt it by about 25 degrees about the image's y|, with the whole board in the image, and take a capture.","Jetzt um etwa 25 Grad um die y-Achse des Bilds neigen, mit der ganzen Tafel im Bild, und aufnehmen."],["Now rotate it by about 40 degrees about the optical axis, tilted|, with the whole board in the image, and take a capture.","Jetzt geneigt um etwa 40 Grad um die optische Achse drehen, mit der ganzen Tafel im Bild, und aufnehmen."],["straight on|, {far} m away","von vorn, aus {far} m"],["tilted by {deg} degrees about the image's {axis}, {far} m away","um {deg} Grad um die {axis}-Achse des Bilds geneigt, aus {far} m"],["{before} mm → {after} mm (95 %)","{before} mm → {after} mm (95 %)"],["then all is determined, to {mm} mm (95 %)","dann ist alles bestimmt, auf {mm} mm (95 %)"],["needed to determine all directions","nötig, um alle Richtungen zu bestimmen"],["as capture {id} was taken","wie Aufnahme {id} gemacht wurde"],["the robot does not reach {count} of {all} poses that would show the target: move the board nearer to the middle of its workspace","Der Roboter erreicht {count} von {all} Posen nicht, die die Tafel zeigen würden: Die Tafel näher zur Mitte seines Arbeitsraums legen"],["{count} of {all} poses that would show the target are in collision, or the path to them is|: move the board, or correct the shapes","{count} von {all} Posen, die die Tafel zeigen würden, sind in Kollision, oder der Weg dorthin: Die Tafel verschieben oder die Formen berichtigen"],["{count} of {all} poses that would show the target are in collision, or the path to them is| ({parts~}): |move the board, or correct the shapes","{count} von {all} Posen, die die Tafel zeigen würden, sind in Kollision, oder der Weg dorthin ({parts~}): Die Tafel verschieben oder die Formen berichtigen"],["in {count} of {all} candidate views the camera would not surely see the whole target: take the first captures near the present pose, or allow other distances","In {count} von {all} möglichen Ansichten sähe die Kamera vielleicht nicht die ganze Tafel: Die ersten Aufnahmen nahe der jetzigen Pose machen oder andere Abstände erlauben"],["{count} of {all} candidate views are like captures that were taken, or that failed","{count} von {all} möglichen Ansichten gleichen Aufnahmen, die gemacht wurden oder misslungen sind"],["1 usable capture|, at least {needed} are needed: {advice*}","1 brauchbare Aufnahme, mindestens {needed} sind nötig: {advice*}"],["{count} usable captures|, at least {needed} are needed: {advice*}","{count} brauchbare Aufnahmen, mindestens {needed} sind nötig: {advice*}"],["take 10 to 15, the robot tilted by 30 degrees and more about two axes","10 bis 15 machen, den Roboter um 30 Grad und mehr um zwei Achsen geneigt"],["take 10 to 15, the robot turned about two axes between them","10 bis 15 machen, den Roboter dazwischen um zwei Achsen gedreht"],["take images of the board from more directions","Bilder der Tafel aus mehr Richtungen aufnehmen"],["has no intrinsics yet: give [camera], or take captures until they can be calibrated","Noch keine Intrinsik: angeben oder aufnehmen, bis sie kalibriert werden kann"],["guess| is missing; |roughly where does the camera sit? {count} captures do not determine it yet: [guess] translation_mm = [x, y, z], optical_axis = [x, y, z], image_x = [x, y, z] (in the flange where the robot carries the camera, else in the base)","Wo etwa sitzt die Kamera? {count} Aufnahmen bestimmen es noch nicht"],["no intrinsics given, and the views do not give them either: {why*}","Keine Intrinsik angegeben, und aus den Ansichten folgt sie auch nicht: {why*}"],["add the camera's intrinsics to the manifest","Die Intrinsik der Kamera angeben"],["where the robot stands now, {part~} collides with {with~}: correct the shapes, or the joint values","Wo der Roboter jetzt steht, kollidiert {part~} mit {with~}: Die Formen oder die Gelenkwerte berichtigen"],["the robot| stands since {s} s","Der Roboter steht seit {s} s"],["the image| stands since {s} s","Das Bild steht seit {s} s"],["nothing has come yet","Noch nichts gekommen"],["typed {s} s ago","Vor {s} s getippt"],["no pose has been typed yet","Noch keine Pose getippt"],["came {s} s ago","Vor {s} s gekommen"],["no pose of the robot for {s} s","Seit {s} s keine Pose des Roboters"],["the robot has just stopped","Der Roboter hat gerade angehalten"],["the robot still moves {speed} mm/s","Der Roboter bewegt sich noch mit {speed} mm/s"],["the robot still rotates {speed} degrees/s","Der Roboter dreht sich noch mit {speed} Grad/s"],["the board was not found a moment ago","Die Tafel wurde eben noch nicht gefunden"],["the image still moves {speed} px/s","Das Bild bewegt sich noch mit {speed} px/s"],["the image has just come to rest","Das Bild ist gerade zur Ruhe gekommen"],["the image has stood for {s} s, but the robot has moved since: it is the image of an earlier pose","Das Bild steht seit {s} s, aber der Roboter hat sich seither bewegt: Es ist das Bild einer früheren Pose"],["waiting {limit} s: how late the images are is not known yet ({s} s)","Warte {limit} s: Wie spät die Bilder kommen, ist noch nicht bekannt ({s} s)"],["the newest image is {s} s old: it may be of before the standstill","Das neueste Bild ist {s} s alt: Es kann von vor dem Stillstand sein"],["the image has changed since the pose was typed: type that of now","Das Bild hat sich geändert, seit die Pose getippt wurde: Die jetzige eintippen"],["waiting for the image of this pose","Warte auf das Bild dieser Pose"],["the image is of before the standstill: take another one","Das Bild ist von vor dem Stillstand: Ein neues aufnehmen"],["no capture was taken: {why*}","Nicht aufgenommen: {why*}"],["the robot's pose is that of capture {id}, but the image has moved by {px} px since: the pose was not read anew, or camera or board were moved","Die Pose des Roboters ist die von Aufnahme {id}, aber das Bild hat sich seither um {px} px bewegt: Die Pose wurde nicht neu gelesen, oder Kamera oder Tafel wurden bewegt"],["the board was expected at this view: drive by hand until it is seen and take it, several times; from the fourth capture on it is found whether notation, unit or direction of the poses, the setup or the board are other than declared","An dieser Ansicht wurde die Tafel erwartet: Von Hand fahren, bis sie zu sehen ist, und aufnehmen, mehrere Male; ab der vierten Aufnahme zeigt sich, ob Schreibweise, Einheit oder Richtung der Posen, der Aufbau oder die Tafel anders sind als angegeben"],["go to another pose from where the whole board is seen, or skip this view","Zu einer anderen Pose fahren, von der die ganze Tafel zu sehen ist, oder diese Ansicht überspringen"],["see that the robot stands and its pose is read anew, then take it again","Darauf achten, dass der Roboter steht und seine Pose neu gelesen wird, dann noch einmal aufnehmen"],["the images come {s} s later than they are taken","Die Bilder kommen {s} s später, als sie aufgenommen werden"],["captures wait for that; a smaller image or no buffer in the camera's software makes it shorter","Die Aufnahmen warten darauf; ein kleineres Bild oder kein Puffer in der Software der Kamera verkürzt es"],["the captures before it are safe; put it right and take the capture again","Die Aufnahmen davor sind sicher; das in Ordnung bringen und noch einmal aufnehmen"],["the image is gone: take the capture again","Das Bild ist fort: noch einmal aufnehmen"],["the image is gone: take it again","Das Bild ist fort: noch einmal aufnehmen"],["the image is {w} x {h} pixels, smaller than a board can be","Das Bild hat {w} x {h} Pixel, weniger als eine Tafel braucht"],["no corners at all","gar keine Ecken"],["{found} of {needed} corners found","{found} von {needed} Ecken gefunden"],["a grid of {w} x {h} corners found, the board has {wide} x {high}: is the target declared as it is?","ein Gitter von {w} x {h} Ecken gefunden, die Tafel hat {wide} x {high}: Ist sie angegeben, wie sie ist?"],["only {found} of {needed} corners are visible, and a partial checkerboard is ambiguous unless its border is visible; show the whole board, or use ChArUco","Nur {found} von {needed} Ecken sind sichtbar, und ein Teil eines Schachbretts ist mehrdeutig, wenn sein Rand nicht zu sehen ist; die ganze Tafel zeigen oder ChArUco verwenden"],["{corners} corners found, but no marker of {dictionary} that belongs to the board: check dictionary, numbers of squares and layout","{corners} Ecken gefunden, aber kein Marker aus {dictionary}, der zur Tafel gehört: Wörterbuch, Zahl der Felder und Anordnung prüfen"],["{read} markers of the board were read, and at most {agreeing} of them lie as declared: check the numbers of squares or tags (x and y may be exchanged), first_id and legacy","{read} Marker der Tafel gelesen, und höchstens {agreeing} davon liegen wie angegeben: Die Zahl der Felder oder Marker (x und y vertauscht?), first_id und legacy prüfen"],["no tag {id} of {dictionary}: check dictionary and id; it needs white around it","kein Marker {id} aus {dictionary}: Wörterbuch und Nummer prüfen; er braucht einen weißen Rand"],["no tags of {dictionary} that lie as on the board: check dictionary, first_id, numbers of tags and border_bits","keine Marker aus {dictionary}, die wie auf der Tafel liegen: Wörterbuch, first_id, Zahl der Marker und border_bits prüfen"],["tag {id} of {dictionary} is there, but its edges are too blurred or covered","Marker {id} aus {dictionary} ist da, aber seine Kanten sind zu unscharf oder verdeckt"],["unknown marker dictionary {name}","unbekanntes Wörterbuch {name}"],["{found} circles found, but no grid of {w} x {h} among them: are columns, rows and the kind right (circle-grid, asymmetric-circle-grid, modified-circle-grid)?","{found} Kreise gefunden, aber darunter kein Gitter von {w} x {h}: Stimmen Spalten, Reihen und Art des Kreisgitters?"],["{kind~} cannot be detected yet: import its corners","{kind~} kann noch nicht erkannt werden: Die Ecken importieren"],["a ball cannot be found in images: it is found in 3D scans only","Eine Kugel wird nicht in Bildern gefunden, nur in 3D-Scans"],["this target has no corners that could be touched","Diese Tafel hat keine Ecken, die man antasten könnte"],["first captures are taken, then corners are touched","Erst aufnehmen, dann Ecken antasten"],["the robot cannot touch the board that it carries: first lay the board into the view, and take its image (`place`)","Die Tafel, die der Roboter trägt, kann er nicht antasten: Erst die Tafel ins Bild legen und ihr Bild aufnehmen"],["the tip is three numbers of millimetres in the flange, not zero and not more than 2 m away","Die Spitze sind drei Zahlen in Millimetern im Flansch, nicht null und nicht mehr als 2 m entfernt"],["corners are touched in the steps `touch` and `verify`","Ecken werden in den Schritten „Antasten“ und „Prüfung“ angetastet"],["first say where the tool's tip is in the flange","Erst angeben, wo die Werkzeugspitze im Flansch ist"],["which corner?","Welche Ecke?"],["the board has no corner {corner}","Die Tafel hat keine Ecke {corner}"],["what came before is still being assessed: touch then","Das Vorige wird noch ausgewertet: danach antasten"],["an image is waited for: touch then, or cancel that","Ein Bild steht noch aus: danach antasten oder abbrechen"],["no touch was taken: {why*}","Nicht angetastet: {why*}"],["type the pose that the pendant shows with the tip at the corner","Die Pose eintippen, die das Bediengerät mit der Spitze an der Ecke zeigt"],["the robot is on its way to the corner","Der Roboter ist auf dem Weg zur Ecke"],["the tip is still where it touched corner {corner}: bring it to the next one","Die Spitze ist noch an Ecke {corner}: Zur nächsten führen"],["there is no touch {id}","Eine Antastung {id} gibt es nicht"],["Where is the tip of the touching tool in the flange? Enter it in millimetres.","Wo im Flansch ist die Werkzeugspitze? In Millimetern eingeben."],["The touch of corner {corner} is rejected as an outlier: the tip was {mm} mm from where the captures put it. Was it this corner, and did the tip slip? Delete it, and touch again.","Die Antastung der Ecke {corner} ist als Ausreißer verworfen: Die Spitze war {mm} mm neben dem Ort aus den Aufnahmen. War es diese Ecke, und ist die Spitze abgerutscht? Löschen und noch einmal antasten."],["Bring the tip to corner {corner} of the board, and touch it.","Die Spitze an Ecke {corner} der Tafel führen und antasten."],["Or finish.","Oder abschließen."],["the board of the captures lies where it is touched: no other one is laid down","Die Tafel der Aufnahmen liegt, wo sie angetastet wird: Eine andere wird nicht hingelegt"],["boards are laid into the view in the steps `touch` and `verify`","Tafeln werden in den Schritten „Antasten“ und „Prüfung“ ins Bild gelegt"],["what came before is still being assessed: take the image then","Das Vorige wird noch ausgewertet: danach das Bild aufnehmen"],["no image of the board was taken: {why*}","Kein Bild der Tafel aufgenommen: {why*}"],["there is no corner to be touched: first {what*}","Es gibt keine Ecke zum Antasten: erst {what*}"],["lay a board into the view (`drive` to `placement`)","eine Tafel ins Bild legen"],["take the image of the board that was laid down (`place`)","das Bild der hingelegten Tafel aufnehmen"],["waiting for an image of the board as it lies","Warte auf ein Bild der Tafel, wie sie liegt"],["see that the whole board lies still in the view, with no other board beside it, and take the image again","Darauf achten, dass die ganze Tafel still im Bild liegt, ohne eine andere daneben, und das Bild noch einmal aufnehmen"],["the board still lies as in placement {id}: touch its corners, or lay it elsewhere first","Die Tafel liegt noch wie in {id}: Ihre Ecken antasten oder sie erst woanders hinlegen"],["this is the board that the robot carries: drive it out of the view or take it off, and lay the board that is to be touched into the view","Das ist die Tafel, die der Roboter trägt: Sie aus dem Bild fahren oder abnehmen und die Tafel, die angetastet wird, ins Bild legen"],["The image of the board is to be taken: {why*}.","Das Bild der Tafel wird aufgenommen: {why*}."],["Lay the board, or another of the same kind, into the view, so that the tool reaches it, and take its image.","Die Tafel oder eine gleiche so ins Bild legen, dass das Werkzeug hinkommt, und ihr Bild aufnehmen."],["Lay the board elsewhere into the view, best at another height, and take its image. Or touch corner {corner} as well, or finish.","Die Tafel woanders ins Bild legen, am besten in anderer Höhe, und ihr Bild aufnehmen. Oder auch Ecke {corner} antasten, oder abschließen."],["first captures are taken until they determine the transform","Erst aufnehmen, bis die Aufnahmen die Transformation bestimmen"],["the captures cannot be assessed","Die Aufnahmen können nicht ausgewertet werden"],["the robot is where {id} was taken: a view from another pose verifies more","Der Roboter ist, wo {id} aufgenommen wurde: Eine Ansicht aus einer anderen Pose prüft mehr"],["Take another view or touch another corner, best where the robot will work, or finish.","Noch eine Ansicht aufnehmen oder noch eine Ecke antasten, am besten dort, wo der Roboter arbeiten wird, oder abschließen."],["The robot is at the view: take it.","Der Roboter ist an der Ansicht: jetzt aufnehmen."],["Drive to the view that is shown, or to where the robot will work, and take it: the calibration is not made with it.","Zur gezeigten Ansicht fahren oder dorthin, wo der Roboter arbeiten wird, und aufnehmen: Die Kalibrierung entsteht nicht daraus."],["Drive to where the robot will work, with the whole board in the image, and take the view: the calibration is not made with it.","Dorthin fahren, wo der Roboter arbeiten wird, mit der ganzen Tafel im Bild, und die Ansicht aufnehmen: Die Kalibrierung entsteht nicht daraus."],["verified by a view: {rms} mm from its prediction, {expected} mm are expected","Geprüft mit einer Ansicht: {rms} mm von ihrer Vorhersage, {expected} mm sind zu erwarten"],["verified by {count} views: {rms} mm (RMS) from their predictions, {expected} mm are expected","Geprüft mit {count} Ansichten: {rms} mm (RMS) von ihren Vorhersagen, {expected} mm sind zu erwarten"],["verified |by a touch: {rms} mm from where the corner is predicted, {expected} mm are expected","Geprüft mit einer Antastung: {rms} mm vom vorhergesagten Ort der Ecke, {expected} mm sind zu erwarten"],["verified |by {count} touches: {rms} mm (RMS) from where the corners are predicted, {expected} mm are expected","Geprüft mit {count} Antastungen: {rms} mm (RMS) von den vorhergesagten Orten der Ecken, {expected} mm sind zu erwarten"],["by a touch: {rms} mm from where the corner is predicted, {expected} mm are expected","mit einer Antastung: {rms} mm vom vorhergesagten Ort der Ecke, {expected} mm sind zu erwarten"],["by {count} touches: {rms} mm (RMS) from where the corners are predicted, {expected} mm are expected","mit {count} Antastungen: {rms} mm (RMS) von den vorhergesagten Orten der Ecken, {expected} mm sind zu erwarten"],["not verified: the touches cannot be assessed: {why*}. Delete them, and touch again","Nicht geprüft: Die Antastungen können nicht ausgewertet werden: {why*}. Sie löschen und noch einmal antasten"],["the captures determine no transform","Die Aufnahmen bestimmen keine Transformation"],["the calibration states no covariance","Die Kalibrierung nennt keine Kovarianz"],["not verified: at all touches the tip was off by about the same, ({x}, {y}, {z}) mm in the base: the tip is elsewhere in the flange than declared, or camera or board were moved since the captures. Measure the tip, delete these touches, and touch again; if something was moved, begin a new session","Nicht bestätigt: Bei allen Antastungen war die Spitze um etwa dasselbe daneben, ({x}, {y}, {z}) mm in der Basis: Die Spitze ist woanders im Flansch als angegeben, oder Kamera oder Tafel wurden seit den Aufnahmen bewegt. Die Spitze vermessen, diese Antastungen löschen und noch einmal antasten; wurde etwas bewegt, eine neue Sitzung beginnen"],["not verified: at corner {corner} the tip was {mm} mm from where the calibration predicts it, and {expected} mm (RMS) are expected. Was it this corner, and did the tip slip? Then delete the touch. If not, camera or board were moved since the captures, or the robot errs there: do not use the result","Nicht bestätigt: An Ecke {corner} war die Spitze {mm} mm neben der Vorhersage der Kalibrierung, und {expected} mm (RMS) sind zu erwarten. War es diese Ecke, und ist die Spitze abgerutscht? Dann die Antastung löschen. Wenn nicht, wurden Kamera oder Tafel seit den Aufnahmen bewegt, oder der Roboter ist dort ungenau: das Ergebnis nicht verwenden"],["not verified: the views cannot be assessed: {why*}. Delete them, and take others","Nicht geprüft: Die Ansichten können nicht ausgewertet werden: {why*}. Sie löschen und andere aufnehmen"],["not verified: in view {id} the board is {mm} mm from where the calibration predicts it, and {expected} mm (RMS) are expected: camera or board were moved since the captures, or the robot errs there. If something was moved, begin a new session, and do not use a result that was written before; if not, take captures there, and delete the view if it is wrong itself","Nicht bestätigt: In Ansicht {id} ist die Tafel {mm} mm neben der Vorhersage der Kalibrierung, und {expected} mm (RMS) sind zu erwarten: Kamera oder Tafel wurden seit den Aufnahmen bewegt, oder der Roboter ist dort ungenau. Wurde etwas bewegt, eine neue Sitzung beginnen und kein früheres Ergebnis verwenden; wenn nicht, dort aufnehmen, und die Ansicht löschen, wenn sie selbst falsch ist"],["the captures determine no transform, too few of them are used, or the views show no board","Die Aufnahmen bestimmen keine Transformation, zu wenige davon werden verwendet, oder die Ansichten zeigen keine Tafel"],["images come by themselves in this session","In dieser Sitzung kommen die Bilder von selbst"],["the step {step*} is not open yet: confirm those before it","Der Schritt „{step*}“ ist noch nicht offen: Erst die davor bestätigen"],["the tolerance is a positive number of millimetres","Der erlaubte Fehler ist eine positive Zahl in Millimetern"],["there is no next view to skip","Es gibt keine nächste Ansicht zum Überspringen"],["captures are retaken in the step `capture`","Aufnahmen werden im Schritt „Aufnahmen“ wiederholt"],["the session is at another step: {step*}","Die Sitzung ist in einem anderen Schritt: {step*}"],["cell","Zelle"],["camera","Kamera"],["robot","Roboter"],["board","Tafel"],["capture","Aufnahmen"],["touch","Antasten"],["verify","Prüfung"],["result","Ergebnis"],["a virtual cell has its own setup, camera and board","Eine virtuelle Zelle hat Aufbau, Kamera und Tafel schon"],["poses come from the robot itself in this session, none are typed","In dieser Sitzung kommen die Posen vom Roboter selbst, es werden keine getippt"],["poses come from the robot in this session, none are typed","In dieser Sitzung kommen die Posen vom Roboter, es werden keine getippt"],["the poses are being read again: in a moment","Die Posen werden gerade neu gelesen: gleich noch einmal"],["captures are taken in the steps `capture` and `verify`","Aufgenommen wird in den Schritten „Aufnahmen“ und „Prüfung“"],["a capture is being stored","Eine Aufnahme wird gerade gespeichert"],["there is no capture {id}","Eine Aufnahme {id} gibt es nicht"],["there is no deleted capture {id}","Eine gelöschte Aufnahme {id} gibt es nicht"],["there is nothing to undo","Es gibt nichts rückgängig zu machen"],["there are no captures yet","Noch keine Aufnahmen"],["the captures are still being assessed: finish then","Die Aufnahmen werden noch ausgewertet: danach abschließen"],["the newest capture, {id}, does not fit to those before it. {what*}","Die neueste Aufnahme, {id}, passt nicht zu denen davor. {what*}"],["no corner is to be touched","Es ist keine Ecke anzutasten"],["there is no next view yet","Noch keine nächste Ansicht"],["no robot is moved but that of a virtual cell: drive it by its pendant","Nur der Roboter einer virtuellen Zelle wird von hier bewegt: Mit dem Bediengerät fahren"],["the session has ended","Die Sitzung ist beendet"],["this is no command: {why~}","Das ist kein Befehl: {why~}"],["commands are like {example~}","Befehle sind wie {example~}"],['"{text~}" holds something else than numbers and names',"„{text~}“ enthält anderes als Zahlen und Namen"],["{count} numbers, but a pose of {notation} has {wanted}: {names~}","{count} Zahlen, aber eine Pose in {notation} hat {wanted}: {names~}"],["the names {given~} are not those of {notation}: {names~}","Die Namen {given~} sind nicht die von {notation}: {names~}"],["{notation} has {count} numbers, these are {given}","{notation} hat {count} Zahlen, dies sind {given}"],["{far} m is farther than any robot reaches: lengths of {notation} are in {unit}","{far} m ist weiter, als ein Roboter reicht: Längen in {notation} sind in {unit}"],["target: {what*}","Tafel: {what*}"],["{w} x {h} {what*}; a board needs at least 2 x 2 ({why*})","{w} x {h} {what*}; eine Tafel braucht mindestens 2 x 2 ({why*})"],["inner corners","innere Ecken"],["circles","Kreise"],["one row of circles does not fix its pose","eine Reihe Kreise legt ihre Pose nicht fest"],["one row of corners does not fix its pose","eine Reihe Ecken legt ihre Pose nicht fest"],["{w} x {h} corners are more than {most}","{w} x {h} Ecken sind mehr als {most}"],["{w} x {h} tags; a board needs at least 1 x 1","{w} x {h} Marker; eine Tafel braucht mindestens 1 x 1"],["markers {first} to {last} are needed, but {dictionary} ends at {end}: take fewer markers or a larger dictionary","Marker {first} bis {last} sind nötig, aber {dictionary} endet bei {end}: Weniger Marker oder ein größeres Wörterbuch nehmen"],["{name} = {value} must be a positive length in mm","{name} = {value} muss eine positive Länge in mm sein"],["{name} = {value} mm is no board's size; is it in millimetres?","{name} = {value} mm hat keine Tafel; ist es in Millimetern?"],["a camera parameter| is not finite","Eine Zahl der Kamera ist nicht endlich"],["camera: fx = {fx}, fy = {fy} must be positive focal lengths in pixels","Kamera: fx = {fx}, fy = {fy} müssen positive Brennweiten in Pixeln sein"],["take {id}","Aufnahme {id}"],["delete {id}","{id} gelöscht"],["restore {id}","{id} zurückgeholt"],["touch {id}","Antastung {id}"],["untouch {id}","Antastung {id} gelöscht"],["place {id}","Tafel {id}"],["there is nothing here","Hier ist nichts"],["see the list of addresses in the book","Siehe die Liste der Adressen im Handbuch"],["begin the session with --upload","Die Sitzung mit --upload beginnen"],["another image is being uploaded","Ein anderes Bild wird gerade übertragen"],["one at a time: send it again then","Eins nach dem anderen: dann noch einmal senden"],["the image cannot be read","Das Bild ist nicht lesbar"],["save it again","Noch einmal sichern"],["PNG, JPEG, TIFF and BMP are read","PNG, JPEG, TIFF und BMP werden gelesen"],["this image has come before: take one of now","Dieses Bild kam schon einmal: Ein neues aufnehmen"],["there is no such capture","Diese Aufnahme gibt es nicht"],["there is no report yet","Noch kein Bericht"],["finish the captures first","Erst die Aufnahmen abschließen"],["the result is not accepted, and is not exported","Das Ergebnis ist nicht angenommen und wird nicht exportiert"],["take more captures","Mehr Aufnahmen machen"],["the verification contradicts the result, and it is not exported","die Prüfung widerspricht dem Ergebnis, und es wird nicht exportiert"],["see the step `verify`","Siehe den Schritt „Prüfung“"],["the result determines no pose","Das Ergebnis bestimmt keine Pose"],["not this host","Nicht dieser Rechner"],["open the address that the session has printed","Die Adresse öffnen, die die Sitzung ausgegeben hat"],["another page asks","Eine fremde Seite fragt"],["open the session's own page","Die eigene Seite der Sitzung öffnen"],["the request has not come to its end","Die Anfrage kam nicht zu Ende"],["ask again","Noch einmal fragen"],["this is too much","Das ist zu viel"],["at most {size} MiB are taken","Höchstens {size} MiB werden angenommen"],["no token, or that of another session","Kein Schlüssel, oder der einer anderen Sitzung"],["the folder {folder~} is gone","Der Ordner {folder~} ist fort"],["is the drive connected? Images are taken again once it is back","Ist das Laufwerk verbunden? Bilder kommen wieder, sobald es da ist"],["save the image again","Das Bild noch einmal sichern"],["no scan lies beside {image~}: save it there under the same name, such as {scan~}","Neben {image~} liegt kein Scan: Ihn dort unter demselben Namen sichern, etwa {scan~}"],["{file~} is still being written","{file~} wird noch geschrieben"],["{file~} is no image: it has {bytes} bytes","{file~} ist kein Bild: {bytes} Byte"],["{file~} is no scan: it has {bytes} bytes","{file~} ist kein Scan: {bytes} Byte"],["{file~}: its points are {m} m away from the camera (median): is the unit of scans another one?","{file~}: Die Punkte sind {m} m von der Kamera entfernt (Median): Ist die Einheit der Scans eine andere?"],["run the command by hand: does it write the image?","Den Befehl von Hand ausführen: Schreibt er das Bild?"],["the command cannot be run: {why~}","Der Befehl ist nicht ausführbar: {why~}"],["the command has not ended after {s} s: {said~}","Der Befehl ist nach {s} s nicht zu Ende: {said~}"],["the command has failed: {said~}","Der Befehl ist misslungen: {said~}"],["the command has written no image to {out}: {said~}","Der Befehl hat kein Bild nach {out} geschrieben: {said~}"],["the command has written an image, and no scan to {scan}: {said~}","Der Befehl hat ein Bild geschrieben, aber keinen Scan nach {scan}: {said~}"],["the command is lost: {why~}","Der Befehl ist verloren: {why~}"],["{file~}: cannot be written: {why~}; check the folder, its permissions and the free space","{file~} kann nicht geschrieben werden: {why~}; Ordner, Rechte und freien Platz prüfen"],["{file~}: |cannot be read: {why~}; check the file","{file~} ist nicht lesbar: {why~}; die Datei prüfen"],["{file~}: |does not exist; check the name and the folder","{file~} gibt es nicht; Name und Ordner prüfen"],["{file~}: |may not be read; check its permissions","{file~} darf nicht gelesen werden; die Rechte prüfen"],["{folder~}: |has captures of another camera, board or setup, or scans in another unit: begin a session in a new folder, or change what is wrong on the page of this session","{folder~} hat Aufnahmen mit anderer Kamera, Tafel, anderem Aufbau oder Scans in anderer Einheit: Eine Sitzung in einem neuen Ordner beginnen oder hier ändern, was falsch ist"],["{folder~}: |has touches of corners, whose numbers are those of the board as it was: delete the touches first","In {folder~} sind Ecken angetastet, nummeriert wie auf der bisherigen Tafel: Erst die Antastungen löschen"],["{folder~}: the pose of {id} |was not typed, the robot gave it|; nothing is read again","{folder~}: Die Pose von {id} wurde nicht getippt, der Roboter gab sie; nichts wird neu gelesen"],["{folder~}: the pose of {id} |is none of {notation}: {why*}; nothing is read again","{folder~}: Die Pose von {id} ist keine in {notation}: {why*}; nichts wird neu gelesen"],["{folder~}: has {most} captures already","{folder~} hat schon {most} Aufnahmen"],["{folder~}: has {most} verification views already","{folder~} hat schon {most} Prüfansichten"],["{folder~}: has {most} placements of the board already","{folder~} hat schon {most} hingelegte Tafeln"],["the robot at {robot} cannot be reached: {why*}","Der Roboter an {robot} ist nicht erreichbar: {why*}"],["it refuses the connection","Er lehnt die Verbindung ab"],["it does not answer","Er antwortet nicht"],["no machine of this name is known","Kein Rechner dieses Namens ist bekannt"],["the robot at {robot} has closed the connection","Der Roboter an {robot} hat die Verbindung beendet"],["the robot at {robot} has sent nothing new for {s} s","Der Roboter an {robot} hat seit {s} s nichts Neues gesendet"],["what comes from {robot} is not RTDE: {what*}","Was von {robot} kommt, ist kein RTDE: {what*}"],["an answer without the types of the fields","eine Antwort ohne die Typen der Felder"],["an answer of another length than asked for","eine Antwort anderer Länge als verlangt"],["{count} bytes of values, other than agreed on","{count} Byte Werte, anders als vereinbart"],["numbers that are no pose of a robot","Zahlen, die keine Pose eines Roboters sind"],["a package of {count} bytes","ein Paket von {count} Byte"],["a package of the unknown kind {kind}","ein Paket der unbekannten Art {kind}"],["the robot at {robot} |does not send {fields~}","Der Roboter an {robot} sendet {fields~} nicht"],["the robot at {robot}, software {software}, |does not send {fields~}","Der Roboter an {robot}, Software {software}, sendet {fields~} nicht"],["the robot at {robot} sends {field} otherwise than as {kind}","Der Roboter an {robot} sendet {field} nicht als {kind}"],["the robot at {robot}, software {software}, sends {field} otherwise than as {kind}","Der Roboter an {robot}, Software {software}, sendet {field} nicht als {kind}"],["the robot at {robot} does not report its TCP: where the flange is stays unknown","Der Roboter an {robot} meldet seinen TCP nicht: Wo der Flansch ist, bleibt unbekannt"],["the robot at {robot}, software {software},| does not report its TCP: where the flange is stays unknown","Der Roboter an {robot}, Software {software}, meldet seinen TCP nicht: Wo der Flansch ist, bleibt unbekannt"],["the robot at {robot} does not begin to send poses","Der Roboter an {robot} beginnt nicht, Posen zu senden"],["the robot at {robot} does not begin to send poses: {said~}","Der Roboter an {robot} beginnt nicht, Posen zu senden: {said~}"],["the arm at {robot} is not powered: it does not know where it is","Der Arm an {robot} ist nicht eingeschaltet: Er weiß nicht, wo er ist"],["is this the address that the pendant shows under Network, is the controller on, and RTDE not disabled among its services? It is tried again every second","Ist das die Adresse, die das Bediengerät unter „Netzwerk“ zeigt, ist die Steuerung an und RTDE unter ihren Diensten nicht gesperrt? Jede Sekunde ein neuer Versuch"],["is the controller being restarted? It is connected to again by itself","Startet die Steuerung neu? Die Verbindung kommt von selbst wieder"],["is the network cable plugged in? It is connected to again by itself","Steckt das Netzwerkkabel? Die Verbindung kommt von selbst wieder"],["is this the address of the robot, and the port that of RTDE, 30004? It is tried again every second","Ist das die Adresse des Roboters, und der Port der von RTDE, 30004? Jede Sekunde ein neuer Versuch"],["update the robot's software; or leave out --ur and type the poses that the pendant shows","Die Software des Roboters erneuern; oder --ur weglassen und die Posen vom Bediengerät eintippen"],["update the robot's software; or set the TCP to zero on the pendant, leave out --ur, and type the poses that it shows","Die Software des Roboters erneuern; oder am Bediengerät den TCP auf null setzen, --ur weglassen und die Posen eintippen"],["restart the controller; it is tried again every second","Die Steuerung neu starten; jede Sekunde ein neuer Versuch"],["switch the arm on at the pendant; poses come by themselves then","Den Arm am Bediengerät einschalten; die Posen kommen dann von selbst"],["the robot gives {given} joint values, its model (URDF) has {own} joints","Der Roboter gibt {given} Gelenkwerte, sein Modell (URDF) hat {own} Gelenke"],["by its model (URDF) the robot's joint values lead to a flange that is {mm} mm and {deg} degrees from where the robot says that it is","Nach seinem Modell (URDF) führen die Gelenkwerte des Roboters zu einem Flansch {mm} mm und {deg} Grad neben dem, den er meldet"],["between its links {base} and {flange} they agree: give {options~}","Zwischen seinen Gliedern {base} und {flange} stimmen sie überein: {options~} angeben"],["no joint values within the limits of the robot's model (URDF) lead to where the flange is","Keine Gelenkwerte in den Grenzen des Robotermodells (URDF) führen dorthin, wo der Flansch ist"],["give the URDF of this robot (--urdf), or its links that are base and flange for these poses (--base-link, --flange-link)","Das URDF dieses Roboters angeben (--urdf) oder die Glieder, die für diese Posen Basis und Flansch sind (--base-link, --flange-link)"],["predicted position error: {mm} mm for 95 % of the points in {where*}","Vorhergesagter Positionsfehler: {mm} mm für 95 % der Punkte in {where*}"],["{mm} mm RMS","{mm} mm RMS"],["{mm} mm (95 %) for a single robot move to a point, robot error included","{mm} mm (95 %) für eine einzelne Bewegung zu einem Punkt, den Fehler des Roboters eingeschlossen"],["the box in which the camera saw the target","dem Quader, in dem die Kamera die Tafel sah"],["the box around the target's origin in all poses","dem Quader um den Ursprung der Tafel in allen Posen"],["the workspace box of the manifest","dem angegebenen Arbeitsraum"],["the predicted error (95 %)| in {where*} is {mm} mm, more than {limit} mm: add captures with more tilt","Der vorhergesagte Fehler (95 %) in {where*} ist {mm} mm, mehr als {limit} mm: Aufnahmen mit mehr Neigung ergänzen"],["the predicted error (95 %)| in {where*} is {mm} mm, more than {limit} mm: add captures with more tilt|, or touches","Der vorhergesagte Fehler (95 %) in {where*} ist {mm} mm, mehr als {limit} mm: Aufnahmen mit mehr Neigung ergänzen oder Ecken antasten"],["the predicted error (95 %)| in {where*} is {mm} mm, more than {limit} mm: the errors drift, so add captures with more tilt, or find out what moves","Der vorhergesagte Fehler (95 %) in {where*} ist {mm} mm, mehr als {limit} mm: Die Fehler driften; Aufnahmen mit mehr Neigung ergänzen oder herausfinden, was sich bewegt"],["too little data to predict an error: add captures or touches","Zu wenig Daten, um einen Fehler vorherzusagen: Aufnahmen oder angetastete Ecken ergänzen"],["the data do not determine {what*}: tilt the robot by 30 degrees and more about two axes, |or touch corners, |or give the position along that direction as `known_position`","Die Daten bestimmen nicht: {what*}. Den Roboter um 30 Grad und mehr um zwei Achsen neigen, Ecken antasten oder die Position in dieser Richtung angeben (known_position)"],["the data do not determine {what*}: tilt the robot by 30 degrees and more about two axes, |or give the position along that direction as `known_position`","Die Daten bestimmen nicht: {what*}. Den Roboter um 30 Grad und mehr um zwei Achsen neigen oder die Position in dieser Richtung angeben (known_position)"],["only {used} of {all} captures agree: captures and robot poses may be out of order, or the pose notation is declared wrongly","Nur {used} von {all} Aufnahmen passen zusammen: Aufnahmen und Posen sind vielleicht nicht in derselben Reihenfolge, oder die Schreibweise der Posen ist falsch angegeben"],["the leave-one-out residual is {mm} mm and {deg} degrees (RMS), much more than a working robot and camera leave: check notation, direction and order of the poses, and `setup`","Das Residuum ausgelassener Aufnahmen ist {mm} mm und {deg} Grad (RMS), viel mehr, als Roboter und Kamera in Ordnung lassen: Schreibweise, Richtung und Reihenfolge der Posen und den Aufbau prüfen"],["the motions do not determine the answer: {what*}","Die Bewegungen bestimmen das Ergebnis nicht: {what*}"],["the robot does not rotate between the captures; tilt it by 30 degrees and more about two axes","Der Roboter dreht sich zwischen den Aufnahmen nicht; ihn um 30 Grad und mehr um zwei Achsen neigen"],["all rotations are about one axis, ({axis~}) of the body that carries the camera (flange or base): the position along it is free; tilt the robot about a second axis, or touch a corner","Alle Drehungen gehen um eine Achse, ({axis~}) des Körpers, der die Kamera trägt (Flansch oder Basis): Die Position längs der Achse ist frei; den Roboter um eine zweite Achse neigen oder eine Ecke antasten"],["no three captures agree on a camera pose: the robot's motions and the camera's have different rotation angles. Are the images and the robot poses of the same captures, in the same order, and the poses read in the right notation?","Keine drei Aufnahmen ergeben dieselbe Pose der Kamera: Die Bewegungen von Roboter und Kamera haben verschiedene Drehwinkel. Gehören Bilder und Posen zu denselben Aufnahmen, in derselben Reihenfolge, und sind die Posen in der richtigen Schreibweise gelesen?"],["captures differ from the others by half turns only, and then two rotations of the camera fit equally well; add captures tilted by other angles","Die Aufnahmen unterscheiden sich von den anderen nur um halbe Drehungen, und dann passen zwei Drehungen der Kamera gleich gut; Aufnahmen mit anderen Neigungen ergänzen"],["the focal length: all views of the board are nearly parallel; tilt it by 20 to 40 degrees in different directions","Die Brennweite: Alle Ansichten der Tafel sind fast parallel; sie um 20 bis 40 Grad in verschiedene Richtungen neigen"],["the rotation of the camera on| flange","Drehung der Kamera am Flansch"],["the rotation of the camera on| base","Drehung der Kamera in der Basis"],["the position of the camera on| flange","Position der Kamera am Flansch"],["the position of the camera on| base","Position der Kamera in der Basis"],["the pose of the camera on the flange","Pose der Kamera am Flansch"],["the pose of the camera on the |base","Pose der Kamera in der Basis"],["rotation about| the rotation axis {axis~} of {frame*}","Drehung um die Drehachse {axis~} ({frame*})"],["translation along the rotation axis {axis~} of {frame*}","Verschiebung längs der Drehachse {axis~} ({frame*})"],["rotation about {axis~} of {frame*}","Drehung um {axis~} ({frame*})"],["translation along {axis~} of {frame*}","Verschiebung längs {axis~} ({frame*})"],["flange","Flansch"],["base","Basis"],["scale of the measured distances","Maßstab der gemessenen Entfernungen"],["the target was not found in it","Die Tafel wurde darin nicht gefunden"],["taken before the camera or the target moved","Aufgenommen, bevor sich Kamera oder Tafel bewegten"],["was taken beside| capture {id}: one capture of each pose counts","Neben Aufnahme {id} aufgenommen: Von jeder Pose zählt eine Aufnahme"],["repeats| capture {id}: one capture of each pose counts","Wiederholt Aufnahme {id}: Von jeder Pose zählt eine Aufnahme"],["no ball was found in its scan","Im Scan wurde keine Kugel gefunden"],["its ball is {mm} mm from where the others put it","Die Kugel ist {mm} mm neben dem Ort aus den anderen"],["it disagrees with the others by {mm} mm and {deg} degrees: {why*}","Sie weicht um {mm} mm und {deg} Grad von den anderen ab: {why*}"],["a robot pose of another moment, a moved target, or a wrong detection","eine Pose des Roboters aus einem anderen Moment, eine bewegte Tafel oder eine falsche Erkennung"],["its robot pose lies {m} m from the base: were millimetres read as metres?","Ihre Pose liegt {m} m von der Basis: Wurden Millimeter als Meter gelesen?"],["its {what*} and that of capture {id} look exchanged; if they are, exchange them in the data","{what*} und das von Aufnahme {id} scheinen vertauscht; wenn ja, in den Daten tauschen"],["its {what*} fits the robot pose of {other*}: from here on images and robot poses seem shifted by one capture; if so, correct the order","{what*} passt zur Pose von {other*}: Ab hier scheinen Bilder und Posen um eine Aufnahme verschoben; wenn ja, die Reihenfolge berichtigen"],["its {what*} fits the robot pose of {other*}","{what*} passt zur Pose von {other*}"],["its robot pose belongs to the {what*} of {other*}; its own is missing","Zu ihrer Pose gehört {what*} von {other*}; die eigene fehlt"],["its robot pose equals that of {other*}, but its {what*} differs: the pose was read before the robot moved; its own pose is missing","Ihre Pose ist die von {other*}, aber {what*} ist anders: Die Pose wurde gelesen, bevor sich der Roboter bewegte; die eigene fehlt"],["image","Das Bild"],["target pose","Die Pose der Tafel"],["the next capture, {id}","der nächsten Aufnahme, {id}"],["the previous capture, {id}","der vorigen Aufnahme, {id}"],["capture {id}","Aufnahme {id}"],["it fits with the target rotated by {deg} degrees: {why*}","Sie passt, wenn die Tafel um {deg} Grad gedreht ist: {why*}"],["it fits with the target rotated by {deg} degrees| about ({middle~}) mm of its own plane|: {why*}","Sie passt, wenn die Tafel um {deg} Grad um ({middle~}) mm ihrer Ebene gedreht ist: {why*}"],["its corners are numbered from another end than in the other images; detect it again, or renumber them","Ihre Ecken sind von einem anderen Ende gezählt als in den anderen Bildern; neu erkennen oder neu nummerieren"],["its pose was found flipped against the other captures","Ihre Pose wurde gegenüber den anderen Aufnahmen umgeklappt gefunden"],["capture {id} rejected: {why*}","Aufnahme {id} verworfen: {why*}"],["{count} of {all} captures disagree with the others and are rejected: {captures*}","{count} von {all} Aufnahmen passen nicht zu den anderen und sind verworfen: {captures*}"],["{captures~} and {count} more","{captures~} und {count} weitere"],["only {count} captures: too few to notice a wrong one or to estimate the noise well; take 10 to 15","Nur {count} Aufnahmen: zu wenige, um eine falsche zu bemerken oder das Rauschen gut zu schätzen; 10 bis 15 machen"],["only {count} captures agree: too few to estimate the noise well","Nur {count} Aufnahmen passen zusammen: zu wenige, um das Rauschen gut zu schätzen"],["captures {captures*} repeat others (same robot pose, same view): the robot's error is the same in all of them, so one capture of each pose counts","Die Aufnahmen {captures*} wiederholen andere (gleiche Pose, gleiche Ansicht): Der Fehler des Roboters ist in allen derselbe, also zählt von jeder Pose eine"],["captures {captures*} were taken within 6 mm and 0.6 degrees of others, and the robot's error there is the same in all of them: one capture of each position counts. Spread the captures over the workspace","Die Aufnahmen {captures*} wurden näher als 6 mm und 0.6 Grad bei anderen gemacht, und der Fehler des Roboters ist dort in allen derselbe: Von jedem Ort zählt eine. Die Aufnahmen über den Arbeitsraum verteilen"],["images and robot poses are in opposite orders: the first image belongs to the last robot pose|: paired so, {agreeing} of {all} captures agree, within {mm} mm; correct the order of the files","Bilder und Posen sind in entgegengesetzter Reihenfolge: Das erste Bild gehört zur letzten Pose: So gepaart passen {agreeing} von {all} Aufnahmen zusammen, auf {mm} mm; die Reihenfolge berichtigen"],["images and robot poses are in opposite orders: the first image belongs to the last robot pose|; correct the order of the files","Bilder und Posen sind in entgegengesetzter Reihenfolge: Das erste Bild gehört zur letzten Pose; die Reihenfolge berichtigen"],["images and robot poses are in different orders: each image belongs to the robot pose {which*}, cyclic (the image of capture {image} to the robot pose of {pose}): paired so, {agreeing} of {all} captures agree, within {mm} mm; correct the order of the files","Bilder und Posen sind in verschiedener Reihenfolge: Jedes Bild gehört zur Pose {which*}, reihum (das Bild von Aufnahme {image} zur Pose von {pose}): So gepaart passen {agreeing} von {all} Aufnahmen zusammen, auf {mm} mm; die Reihenfolge berichtigen"],["images and robot poses are in different orders: each image belongs to the robot pose {which*}, cyclic (the image of capture {image} to the robot pose of {pose})|; correct the order of the files","Bilder und Posen sind in verschiedener Reihenfolge: Jedes Bild gehört zur Pose {which*}, reihum (das Bild von Aufnahme {image} zur Pose von {pose}); die Reihenfolge berichtigen"],["1 capture back","eine Aufnahme davor"],["1 capture| further on","eine Aufnahme danach"],["{count} captures| back","{count} Aufnahmen davor"],["{count} captures further on","{count} Aufnahmen danach"],["the images of these captures are exchanged: {captures*}; exchange the files, or leave them out","Die Bilder dieser Aufnahmen sind vertauscht: {captures*}; die Dateien tauschen oder sie weglassen"],["these captures have one and the same robot pose, but the camera saw the target move: the pose was not read anew; leave them out: {captures*}","Diese Aufnahmen haben ein und dieselbe Pose des Roboters, aber die Kamera sah die Tafel sich bewegen: Die Pose wurde nicht neu gelesen; weglassen: {captures*}"],["these captures show the target in the same place, but the robot moved: images were stored twice, or target and camera are mounted on the same body: {captures*}","Diese Aufnahmen zeigen die Tafel am selben Ort, aber der Roboter bewegte sich: Bilder wurden doppelt gespeichert, oder Tafel und Kamera sitzen am selben Körper: {captures*}"],["these captures agree with no others, and no single mistake explains them; look at their images and robot poses, or leave them out: {captures*}","Diese Aufnahmen passen zu keinen anderen, und kein einzelner Fehler erklärt sie; ihre Bilder und Posen ansehen oder sie weglassen: {captures*}"],["only {used} of {all} captures agree: too few to outvote the others; take more captures, or find out what was wrong with these","Nur {used} von {all} Aufnahmen passen zusammen: zu wenige, um die anderen zu überstimmen; mehr Aufnahmen machen oder herausfinden, was mit diesen nicht stimmt"],["{used} captures agree on one answer and {others} of the other {rest} on another one: the data cannot tell which is right; check what changed between them","{used} Aufnahmen ergeben ein Ergebnis und {others} der anderen {rest} ein anderes: Die Daten sagen nicht, welches stimmt; prüfen, was sich dazwischen geändert hat"],["the target was not found in {count} images of {all} captures ({id}: {why*}): check [target]","Die Tafel wurde in {count} Bildern von {all} Aufnahmen nicht gefunden ({id}: {why*}): Die Angaben zur Tafel prüfen"],["captures were rejected because images and robot poses are out of order","Aufnahmen wurden verworfen, weil Bilder und Posen nicht in derselben Reihenfolge sind"],["correct the order of the files or lines","Die Reihenfolge der Dateien oder Zeilen berichtigen"],["many captures were rejected as outliers","Viele Aufnahmen wurden als Ausreißer verworfen"],["find out what they have in common: something moved, or the robot errs there","Herausfinden, was sie gemeinsam haben: Etwas wurde bewegt, oder der Roboter ist dort ungenau"],["find out what changed in the session, and take it again","Herausfinden, was sich in der Sitzung geändert hat, und sie wiederholen"],["either {what*}","Entweder {what*}"],["or {what*}","Oder {what*}"],["but {what*}","Aber {what*}"],["and they are {how*}","Und sie sind {how*}"],["{what*} (the |camera| is then {m} m from the flange)","{what*} (die Kamera ist dann {m} m vom Flansch)"],["{what*} (the |target| is then {m} m from the flange)","{what*} (die Tafel ist dann {m} m vom Flansch)"],["the robot poses are {how*}","Die Posen des Roboters sind {how*}"],["written as {new}, not {old}","als {new} geschrieben, nicht als {old}"],["written as {new} (that of {makers~} and {last}), not {old}","als {new} geschrieben (wie {makers~} und {last}), nicht als {old}"],["in {new}, not {old}","in {new}, nicht {old}"],["with angles in {new}, not {old}","mit Winkeln in {new}, nicht {old}"],["flange_from_base|, not |base_from_flange","flange_from_base, nicht base_from_flange"],["base_from_flange|, not |flange_from_base","base_from_flange, nicht flange_from_base"],["the angles stand before the positions in the robot poses: their columns are exchanged","In den Posen des Roboters stehen die Winkel vor den Positionen: Ihre Spalten sind vertauscht"],["{axis} of the robot positions has the wrong sign","{axis} der Positionen des Roboters hat das falsche Vorzeichen"],["an axis of the robot's base frame is mirrored (x, y or z: the data cannot tell), or the images are","Eine Achse der Roboterbasis ist gespiegelt (x, y oder z: Das sagen die Daten nicht), oder die Bilder sind es"],["the rotations of the robot poses turn the other way: they are transposed, or their angles have the wrong sign","Die Drehungen der Posen gehen andersherum: Sie sind transponiert, oder ihre Winkel haben das falsche Vorzeichen"],["the setup is {other}, not {own}, and the robot poses are as declared","Der Aufbau ist {other}, nicht {own}, und die Posen des Roboters sind wie angegeben"],["the board poses are {other}, and the robot poses as declared","Die Posen der Tafel sind {other}, die des Roboters wie angegeben"],["setup = {value}","setup = {value}"],["the robot moves {value} +- {sigma} times as far as it says, and the target is as declared","Der Roboter bewegt sich {value} +- {sigma} mal so weit, wie er sagt, und die Tafel ist wie angegeben"],["the robot poses lie up to {m} m from the base: were millimetres read as metres? check the length unit","Die Posen des Roboters liegen bis zu {m} m von der Basis: Wurden Millimeter als Meter gelesen? Die Längeneinheit prüfen"],["the target poses lie {m} m from the camera: were millimetres read as metres? check the length unit","Die Posen der Tafel liegen {m} m von der Kamera: Wurden Millimeter als Meter gelesen? Die Längeneinheit prüfen"],["either the robot poses look inverted (flange_from_base), or the target poses (target_from_camera), or `setup` is declared wrongly (eye-in-hand or eye-to-hand); the data cannot tell between these|: with that the median residual falls from {before*} to {after} mm; check `direction` and `setup`","Entweder scheinen die Posen des Roboters umgekehrt (flange_from_base), oder die der Tafel (target_from_camera), oder der Aufbau ist falsch angegeben (eye-in-hand oder eye-to-hand); die Daten unterscheiden das nicht: Damit fällt das mittlere Residuum von {before*} auf {after} mm; Richtung der Posen und Aufbau prüfen"],["the robot poses look inverted (flange_from_base), or `setup` is declared wrongly (eye-in-hand or eye-to-hand)|: with that the median residual falls from {before*} to {after} mm; check `direction` and `setup`","Die Posen des Roboters scheinen umgekehrt (flange_from_base), oder der Aufbau ist falsch angegeben (eye-in-hand oder eye-to-hand): Damit fällt das mittlere Residuum von {before*} auf {after} mm; Richtung der Posen und Aufbau prüfen"],["no agreement at all","keiner Übereinstimmung"],["correct `direction` or `setup`","Richtung der Posen oder Aufbau berichtigen"],["correct `length_unit`","Die Längeneinheit berichtigen"],["give robot and camera in the same unit","Roboter und Kamera in derselben Einheit angeben"],["the target is {value} +- {sigma} times as large as declared ({found} mm instead of {declared} mm)|; measure it, and correct it","Die Tafel ist {value} +- {sigma} mal so groß wie angegeben ({found} mm statt {declared} mm); messen und berichtigen"],["the target is {value} +- {sigma} times as large as declared ({found} mm instead of {declared} mm): {why*}; measure it, and correct it","Die Tafel ist {value} +- {sigma} mal so groß wie angegeben ({found} mm statt {declared} mm): {why*}; messen und berichtigen"],["the target is {value} +- {sigma} % {which*} than declared ({found} mm instead of {declared} mm): {why*}; measure it, and correct [target]. If the declared size is right, the focal length or the robot's own scale is wrong","Die Tafel ist {value} +- {sigma} % {which*} als angegeben ({found} mm statt {declared} mm): {why*}; messen und berichtigen. Stimmt die angegebene Größe, ist die Brennweite oder der Maßstab des Roboters falsch"],["the target is {value} +- {sigma} % {which*} than declared ({found} mm instead of {declared} mm)|; measure it, and correct [target]. If the declared size is right, the focal length or the robot's own scale is wrong","Die Tafel ist {value} +- {sigma} % {which*} als angegeben ({found} mm statt {declared} mm); messen und berichtigen. Stimmt die angegebene Größe, ist die Brennweite oder der Maßstab des Roboters falsch"],["the target is {value} +- {sigma} % {which*} than declared ({found} mm instead of {declared} mm|): the answer uses the estimated size; measure the print with a caliper and declare the measured size. If the declared size is right, the focal length or the robot's own scale is wrong","Die Tafel ist {value} +- {sigma} % {which*} als angegeben ({found} mm statt {declared} mm): Das Ergebnis rechnet mit der geschätzten Größe; den Druck mit einem Messschieber messen und die gemessene Größe angeben. Stimmt die angegebene Größe, ist die Brennweite oder der Maßstab des Roboters falsch"],["the data say that the target is {value} +- {sigma} % {which*} than declared ({found} mm instead of {declared} mm|), but it is declared as measured, and the answer uses the declared size: the focal length or the robot's own scale is wrong","Nach den Daten ist die Tafel {value} +- {sigma} % {which*} als angegeben ({found} mm statt {declared} mm), aber die Größe gilt als gemessen, und das Ergebnis rechnet mit ihr: Die Brennweite oder der Maßstab des Roboters ist falsch"],["larger","größer"],["smaller","kleiner"],["longer","länger"],["shorter","kürzer"],["farther","weiter"],["nearer","näher"],["the length was given in centimetres and counts as millimetres","Die Länge wurde in Zentimetern angegeben und zählt als Millimeter"],["the declared length is ten times too large: millimetres were taken for centimetres","Die angegebene Länge ist zehnmal zu groß: Millimeter wurden für Zentimeter gehalten"],["the length was given in metres and counts as millimetres","Die Länge wurde in Metern angegeben und zählt als Millimeter"],["the declared length is a thousand times too large: micrometres, or millimetres taken for metres","Die angegebene Länge ist tausendmal zu groß: Mikrometer, oder Millimeter für Meter gehalten"],["the length was given in inches and counts as millimetres","Die Länge wurde in Zoll angegeben und zählt als Millimeter"],["the declared length is 25.4 times too large: millimetres were taken for inches","Die angegebene Länge ist 25.4-mal zu groß: Millimeter wurden für Zoll gehalten"],["half of the length was given","Die halbe Länge wurde angegeben"],["twice the length was given: that of two squares, or of a circle grid's other pitch","Die doppelte Länge wurde angegeben: Die zweier Felder, oder der andere Abstand eines Kreisgitters"],["a length of {right} squares was divided by {counted}: squares and corners were mixed up","Eine Länge von {right} Feldern wurde durch {counted} geteilt: Felder und Ecken wurden verwechselt"],["target poses and robot poses have different length units ({units*}): distances to the target are {factor} times too large","Posen von Tafel und Roboter haben verschiedene Längeneinheiten ({units*}): Entfernungen zur Tafel sind {factor}-mal zu groß"],["millimetres and metres","Millimeter und Meter"],["millimetres and centimetres","Millimeter und Zentimeter"],["centimetres and metres","Zentimeter und Meter"],["the robot's motions say that distances to the target are {value} +- {sigma} % {which*} than measured: the unit or the scale of the measurements, or the robot's own scale, is wrong","Nach den Bewegungen des Roboters sind die Entfernungen zur Tafel {value} +- {sigma} % {which*} als gemessen: Einheit oder Maßstab der Messungen oder der Maßstab des Roboters ist falsch"],["the answer uses the estimated size of the target ({found} mm), not the declared one ({declared} mm)","Das Ergebnis rechnet mit der geschätzten Größe der Tafel ({found} mm), nicht mit der angegebenen ({declared} mm)"],["the answer uses the estimated size of the target, not the declared one","Das Ergebnis rechnet mit der geschätzten Größe der Tafel, nicht mit der angegebenen"],["the answer uses the measured size of the target ({declared} mm), but {found} mm fits the captures","Das Ergebnis rechnet mit der gemessenen Größe der Tafel ({declared} mm), aber {found} mm passt zu den Aufnahmen"],["the captures contradict the measured size of the target, which the answer uses","Die Aufnahmen widersprechen der gemessenen Größe der Tafel, mit der das Ergebnis rechnet"],["measure the target again; if it is right, the focal length or the robot's own scale is wrong","Die Tafel noch einmal messen; stimmt ihre Größe, ist die Brennweite oder der Maßstab des Roboters falsch"],["measure the target and declare its size","Die Tafel messen und ihre Größe angeben"],["the board is {value} +- {sigma} % {which*} along y than along x: the answer uses that shape; measure the print along both sides, and use a print with the same square size in x and y","Die Tafel ist entlang y {value} +- {sigma} % {which*} als entlang x: Das Ergebnis rechnet mit dieser Form; den Druck an beiden Seiten messen und einen mit gleich großen Feldern in x und y verwenden"],["the answer uses a board that is {value} % {which*} along y, not the declared one","Das Ergebnis rechnet mit einer Tafel, die entlang y {value} % {which*} ist, nicht mit der angegebenen"],["measure the print along both sides, and print it again or have a plate made","Den Druck an beiden Seiten messen und neu drucken oder eine Platte fertigen lassen"],["the corners in the images show that the board is bent by {mm} mm from its highest to its lowest corner: the answer uses that shape; lay it on a flat plate and check it with a straight edge","Die Ecken in den Bildern zeigen, dass die Tafel um {mm} mm gebogen ist, von der höchsten zur tiefsten Ecke: Das Ergebnis rechnet mit dieser Form; auf eine ebene Platte legen und mit einem Lineal prüfen"],["the answer uses a board that is bent by {mm} mm, not a flat one","Das Ergebnis rechnet mit einer um {mm} mm gebogenen Tafel, nicht mit einer ebenen"],["glue the board to a flat plate","Die Tafel auf eine ebene Platte kleben"],["in the scans of {count} captures the board is bent by {mm} +- {sigma} mm from its highest to its lowest corner: lay it on a flat plate and check it with a straight edge; if it is flat, the 3D camera distorts flat surfaces","In den Scans von {count} Aufnahmen ist die Tafel um {mm} +- {sigma} mm gebogen, von der höchsten zur tiefsten Ecke: auf eine ebene Platte legen und mit einem Lineal prüfen; ist sie eben, verzerrt die 3D-Kamera ebene Flächen"],["the given intrinsics do not fit images and robot poses; refined: {what*}. The result uses the refined intrinsics (key `camera`); use them for your images too, or recalibrate the camera","Die angegebene Intrinsik passt nicht zu Bildern und Posen; verfeinert: {what*}. Das Ergebnis rechnet mit der verfeinerten Intrinsik (`camera`); sie auch für Ihre Bilder verwenden oder die Kamera neu kalibrieren"],["the given intrinsics do not fit images and robot poses; refined: {what*}. The result uses the refined intrinsics (key `camera`); use them for your images too, or recalibrate the camera|. Both moved by half a pixel: the given cx and cy seem to count from the corner of the first pixel and the target's corners from its centre, or the other way round; if so, correct them","Die angegebene Intrinsik passt nicht zu Bildern und Posen; verfeinert: {what*}. Das Ergebnis rechnet mit der verfeinerten Intrinsik (`camera`); sie auch für Ihre Bilder verwenden oder die Kamera neu kalibrieren. Beide sind um ein halbes Pixel verschoben: Die angegebenen cx und cy zählen wohl von der Ecke des ersten Pixels und die Ecken der Tafel von seiner Mitte, oder umgekehrt; wenn ja, berichtigen"],["the distortion alone, focal lengths and principal point are as given","nur die Verzeichnung, Brennweiten und Hauptpunkt sind wie angegeben"],["the answer uses refined intrinsics ({name} {from} -> {to} px), not the given ones","Das Ergebnis rechnet mit verfeinerter Intrinsik ({name} {from} -> {to} px), nicht mit der angegebenen"],["the answer uses refined intrinsics, not the given ones","Das Ergebnis rechnet mit verfeinerter Intrinsik, nicht mit der angegebenen"],["use the intrinsics in `camera` for your images too, or calibrate the camera again","Die Intrinsik unter `camera` auch für Ihre Bilder verwenden oder die Kamera neu kalibrieren"],["no intrinsics given: calibrated from {views} images, {rms} px RMS, fx = {fx} px, fy = {fy} px; a separate calibration, with the board all over the image, is better","Keine Intrinsik angegeben: aus {views} Bildern kalibriert, {rms} px RMS, fx = {fx} px, fy = {fy} px; eine eigene Kalibrierung mit der Tafel im ganzen Bild ist besser"],["no intrinsics given: calibrated from {views} images, {rms} px RMS, fx = {fx} px, fy = {fy} px; a separate calibration, with the board all over the image, is better|. The answer uses the camera refined with the robot's poses: {camera~}","Keine Intrinsik angegeben: aus {views} Bildern kalibriert, {rms} px RMS, fx = {fx} px, fy = {fy} px; eine eigene Kalibrierung mit der Tafel im ganzen Bild ist besser. Das Ergebnis rechnet mit der Kamera, die mit den Posen des Roboters verfeinert ist: {camera~}"],["the camera is given without distortion, but the target's corners show one: k1 = {k1} +- {sigma} reduces their residual from {before} to {after} px RMS and is used; calibrate the camera with a board all over the image","Die Kamera ist ohne Verzeichnung angegeben, aber die Ecken der Tafel zeigen eine: k1 = {k1} +- {sigma} senkt ihr Residuum von {before} auf {after} px RMS und wird verwendet; die Kamera mit einer Tafel im ganzen Bild kalibrieren"],["the answer uses a distortion that was not given (k1 = {k1})","Das Ergebnis rechnet mit einer Verzeichnung, die nicht angegeben war (k1 = {k1})"],["the answer uses a distortion that was not given","Das Ergebnis rechnet mit einer Verzeichnung, die nicht angegeben war"],["calibrate the camera's distortion","Die Verzeichnung der Kamera kalibrieren"],["captures {first} to {last} agree with one another, {mm} mm and {deg} degrees away from the others|: {causes*}","Die Aufnahmen {first} bis {last} passen zueinander, {mm} mm und {deg} Grad neben den anderen: {causes*}"],["the captures from {first} on differ from those before by {mm} mm and {deg} degrees: {causes*}","Die Aufnahmen ab {first} weichen von denen davor um {mm} mm und {deg} Grad ab: {causes*}"],["errors grow evenly by {mm} mm and {deg} degrees| from capture {first} to {last}: {causes*}","Die Fehler wachsen gleichmäßig um {mm} mm und {deg} Grad von Aufnahme {first} bis {last}: {causes*}"],["the camera moved on the |flange","Die Kamera hat sich am Flansch bewegt"],["the camera moved on the |base","Die Kamera hat sich in der Basis bewegt"],["the target moved","Die Tafel hat sich bewegt"],["the target moved on the flange","Die Tafel hat sich am Flansch bewegt"],["the robot errs by as much at these poses","Der Roboter ist an diesen Posen so ungenau"],["the robot's error changed with its pose","Der Fehler des Roboters hat sich mit seiner Pose geändert"],["the stated error covers it","Der angegebene Fehler schließt es ein"],["Tighten loose mounts, and take the captures again","Lose Halterungen festziehen und die Aufnahmen wiederholen"],["Warm up, tighten loose mounts, and take the captures again","Warmlaufen lassen, lose Halterungen festziehen und die Aufnahmen wiederholen"],["The result is the camera's pose from capture {first} on, from these {count} captures alone","Das Ergebnis ist die Pose der Kamera ab Aufnahme {first}, allein aus diesen {count} Aufnahmen"],["the touches may be older, and are not used","Die Antastungen sind vielleicht älter und werden nicht verwendet"],["these do not determine an answer alone: take more captures with the camera at its current pose","Diese allein bestimmen kein Ergebnis: mehr Aufnahmen mit der Kamera in ihrer jetzigen Lage machen"],["the last capture, {id}, is {mm} mm and {deg} degrees away from the others, and whether the camera was moved before it is unknown: take another capture, which shows it, or leave {id} out if nothing was moved","Die letzte Aufnahme, {id}, liegt {mm} mm und {deg} Grad neben den anderen, und ob die Kamera davor bewegt wurde, ist unbekannt: Eine weitere Aufnahme zeigt es; wurde nichts bewegt, {id} weglassen"],["the last capture, {id}, is {mm} mm away from the others, and the stated error covers that the camera was moved before it","Die letzte Aufnahme, {id}, liegt {mm} mm neben den anderen, und der angegebene Fehler schließt ein, dass die Kamera davor bewegt wurde"],["the last capture does not agree with the others, and the stated error covers that the camera was moved before it","Die letzte Aufnahme passt nicht zu den anderen, und der angegebene Fehler schließt ein, dass die Kamera davor bewegt wurde"],["take another capture: it shows whether the camera was moved","Eine weitere Aufnahme machen: Sie zeigt, ob die Kamera bewegt wurde"],["the target lay elsewhere during captures {first} to {last}: it was moved in the session; leave them out","Die Tafel lag bei den Aufnahmen {first} bis {last} woanders: Sie wurde in der Sitzung bewegt; diese weglassen"],["the camera was moved on the |flange| before capture {first}; leave the captures before that out: the calibration is to be for where the camera is now","Die Kamera wurde vor Aufnahme {first} am Flansch bewegt; die Aufnahmen davor weglassen: Die Kalibrierung soll für die jetzige Lage der Kamera gelten"],["the camera was moved on the |base| before capture {first}; leave the captures before that out: the calibration is to be for where the camera is now","Die Kamera wurde vor Aufnahme {first} in der Basis bewegt; die Aufnahmen davor weglassen: Die Kalibrierung soll für die jetzige Lage der Kamera gelten"],["the camera had another pose on the |flange| during captures {first} to {last}: it was moved in the session; leave them out","Die Kamera saß bei den Aufnahmen {first} bis {last} anders am Flansch: Sie wurde in der Sitzung bewegt; diese weglassen"],["the camera had another pose on the |base| during captures {first} to {last}: it was moved in the session; leave them out","Die Kamera stand bei den Aufnahmen {first} bis {last} anders in der Basis: Sie wurde in der Sitzung bewegt; diese weglassen"],["captures were rejected one after the other and agree with one another","Aufnahmen wurden nacheinander verworfen und passen zueinander"],["find out whether something moved or the robot errs there","Herausfinden, ob sich etwas bewegt hat oder der Roboter dort ungenau ist"],["something moved by {mm} mm during the session, and the stated error covers it","Etwas hat sich in der Sitzung um {mm} mm bewegt, und der angegebene Fehler schließt es ein"],["something moved during the session, and the stated error covers it","Etwas hat sich in der Sitzung bewegt, und der angegebene Fehler schließt es ein"],["tighten the mounts of camera, target and tool, and take the captures again","Die Halterungen von Kamera, Tafel und Werkzeug festziehen und die Aufnahmen wiederholen"],["the camera moved by {mm} mm during the session, and the result is its pose since then","Die Kamera hat sich in der Sitzung um {mm} mm bewegt, und das Ergebnis ist ihre Pose seither"],["the camera moved during the session, and the result is its pose since then","Die Kamera hat sich in der Sitzung bewegt, und das Ergebnis ist ihre Pose seither"],["fasten the camera and the target, and take the captures again","Kamera und Tafel befestigen und die Aufnahmen wiederholen"],["the arm differs from its model: with {count} parameters corrected, the error of the robot's position is {after} mm per axis instead of {before} mm. The result contains the corrected model (key `arm`), and the camera's pose for a robot that uses it; the answer itself is for the robot as it is","Der Arm weicht von seinem Modell ab: Mit {count} berichtigten Parametern ist der Positionsfehler des Roboters {after} mm je Achse statt {before} mm. Das Ergebnis enthält das berichtigte Modell (`arm`) und die Pose der Kamera für einen Roboter, der damit rechnet; das Ergebnis selbst gilt für den Roboter, wie er ist"],["the arm is not built as its model says, and the answer takes that into account","Der Arm ist nicht so gebaut, wie sein Modell sagt, und das Ergebnis berücksichtigt es"],["use the corrected arm in programs that compute positions themselves","Den berichtigten Arm in Programmen verwenden, die Positionen selbst rechnen"],["whether the robot's error depends on its pose is open: with a probability of {share} % it does, so the predicted error is {mm} mm RMS instead of {other} mm. Joint values and a model of the arm decide it; touches where the robot works verify the result","Offen ist, ob der Fehler des Roboters von seiner Pose abhängt: mit einer Wahrscheinlichkeit von {share} %, und so ist der vorhergesagte Fehler {mm} mm RMS statt {other} mm. Gelenkwerte und ein Modell des Arms entscheiden es; Antastungen, wo der Roboter arbeitet, prüfen das Ergebnis"],["the robot's error depends on its pose: this robot errs by {mm} mm| from place to place, and the best fixed transform leaves {left} mm RMS at the captures. More captures do not reduce that; {what*}","Der Fehler des Roboters hängt von seiner Pose ab: Er ist von Ort zu Ort um {mm} mm ungenau, und die beste feste Transformation lässt an den Aufnahmen {left} mm RMS. Mehr Aufnahmen senken das nicht; {what*}"],["the robot's error depends on its pose: this robot errs by {mm} mm and {deg} degrees| from place to place, and the best fixed transform leaves {left} mm RMS at the captures. More captures do not reduce that; {what*}","Der Fehler des Roboters hängt von seiner Pose ab: Er ist von Ort zu Ort um {mm} mm und {deg} Grad ungenau, und die beste feste Transformation lässt an den Aufnahmen {left} mm RMS. Mehr Aufnahmen senken das nicht; {what*}"],["robot poses corrected with `handeye compensate` do: held-out captures then have {with} mm RMS instead of {without} mm","Posen, die mit `handeye compensate` berichtigt sind, tun es: Ausgelassene Aufnahmen haben dann {with} mm RMS statt {without} mm"],["a calibration of the robot's kinematics does, or captures in its work area only","Eine Kalibrierung der Kinematik des Roboters tut es, oder Aufnahmen nur im Arbeitsbereich"],["the robot's error depends on its pose: the best fixed transform leaves {mm} mm RMS at the captures","Der Fehler des Roboters hängt von seiner Pose ab: Die beste feste Transformation lässt an den Aufnahmen {mm} mm RMS"],["the robot's error depends on its pose, and no fixed transform is exact everywhere","Der Fehler des Roboters hängt von seiner Pose ab, und keine feste Transformation ist überall genau"],["take captures in the work area, with the tool oriented as at work; have the robot's kinematics calibrated","Im Arbeitsbereich aufnehmen, mit dem Werkzeug wie bei der Arbeit; die Kinematik des Roboters kalibrieren lassen"],["residuals of neighbouring captures are correlated ({value}): errors change slowly with the pose, and the answer is less certain than stated","Die Residuen benachbarter Aufnahmen hängen zusammen ({value}): Die Fehler ändern sich langsam mit der Pose, und das Ergebnis ist weniger sicher als angegeben"],["errors change slowly from capture to capture: {what*}; the answer takes it into account","Die Fehler ändern sich langsam von Aufnahme zu Aufnahme: {what*}; das Ergebnis berücksichtigt es"],["errors change slowly from capture to capture: {what*}; it has no single pose on its mount: fasten it, and take the captures again","Die Fehler ändern sich langsam von Aufnahme zu Aufnahme: {what*}; sie hat keine feste Pose in ihrer Halterung: befestigen und die Aufnahmen wiederholen"],["the target or the robot seems to move| by {deg} degrees and {mm} mm per axis| from one capture to the next","Tafel oder Roboter scheinen sich von einer Aufnahme zur nächsten um {deg} Grad und {mm} mm je Achse zu bewegen"],["the camera seems to move in its holder| by {deg} degrees and {mm} mm per axis| from one capture to the next","Die Kamera scheint sich in ihrer Halterung von einer Aufnahme zur nächsten um {deg} Grad und {mm} mm je Achse zu bewegen"],["errors changed slowly during the session, and the answer takes that into account","Die Fehler haben sich in der Sitzung langsam geändert, und das Ergebnis berücksichtigt es"],["warm up, and look for something that gives way","Warmlaufen lassen und suchen, was nachgibt"],['the touch of corner {corner} of "{placement}"| is rejected: it is too far from where all other data put that corner (p = {p}): a wrong corner id, or the tip slipped. Check the id, and touch the corner again',"Die Antastung der Ecke {corner} von „{placement}“ ist verworfen: Sie ist zu weit vom Ort aus allen anderen Daten (p = {p}): eine falsche Ecke, oder die Spitze ist abgerutscht. Die Nummer prüfen und die Ecke noch einmal antasten"],['the touch of corner {corner} of |""| is rejected: it is too far from where all other data put that corner (p = {p}): a wrong corner id, or the tip slipped. Check the id, and touch the corner again',"Die Antastung der Ecke {corner} ist verworfen: Sie ist zu weit vom Ort aus allen anderen Daten (p = {p}): eine falsche Ecke, oder die Spitze ist abgerutscht. Die Nummer prüfen und die Ecke noch einmal antasten"],['the touch of corner {corner} of "{placement}"| is rejected: it is {mm} mm from where views and other touches put that corner{why*}',"Die Antastung der Ecke {corner} von „{placement}“ ist verworfen: Sie ist {mm} mm neben dem Ort aus Ansichten und anderen Antastungen{why*}"],['the touch of corner {corner} of |""| is rejected: it is {mm} mm from where views and other touches put that corner{why*}',"Die Antastung der Ecke {corner} ist verworfen: Sie ist {mm} mm neben dem Ort aus Ansichten und anderen Antastungen{why*}"],[": a wrong corner id, or the tip slipped. Check the id, and touch the corner again",": eine falsche Ecke, oder die Spitze ist abgerutscht. Die Nummer prüfen und die Ecke noch einmal antasten"],["; it looks exchanged with that of corner {corner}","; sie scheint mit der von Ecke {corner} vertauscht"],['the touch of corner {corner} of "{placement}"| was rejected as an outlier',"Die Antastung der Ecke {corner} von „{placement}“ wurde als Ausreißer verworfen"],['the touch of corner {corner} of |""| was rejected as an outlier',"Die Antastung der Ecke {corner} wurde als Ausreißer verworfen"],["a touch was rejected as an outlier","Eine Antastung wurde als Ausreißer verworfen"],["check the corner id of that touch, and touch it again","Die Nummer der Ecke prüfen und sie noch einmal antasten"],["images and touches contradict each other: {what*}. As declared, only {agreeing} of {all} touches fit one common tool tip, and half of the touches are more than {mm} mm from where the images put their corners","Bilder und Antastungen widersprechen einander: {what*}. Wie angegeben passen nur {agreeing} von {all} Antastungen zu einer gemeinsamen Werkzeugspitze, und die Hälfte ist mehr als {mm} mm neben den Ecken aus den Bildern"],["the touches agree if their unit is {new}, not {old}: correct length_unit of [touches]","Die Antastungen passen in der Einheit {new}, nicht {old}: Die Längeneinheit berichtigen"],["in_flange_mm of [touches.tip] seems to be in metres (multiplied by 1000, the touches agree): give it in millimetres","Die Werkzeugspitze ist wohl in Metern angegeben (mal 1000 passen die Antastungen): In Millimetern angeben"],["{how*}: correct the corner ids of the touches","{how*}: Die Nummern der Ecken berichtigen"],["the board is rotated by 180 degrees against the ids of the touches","Die Tafel ist gegenüber den Nummern der Ecken um 180 Grad gedreht"],["the corners are counted from 1, and ids count from 0","Die Ecken sind ab 1 gezählt, die Nummern beginnen bei 0"],["the corner ids of the touches are one too small","Die Nummern der angetasteten Ecken sind um eins zu klein"],["the corners are counted column by column, and ids count row by row","Die Ecken sind spaltenweise gezählt, die Nummern gehen reihenweise"],["the columns are counted from the other side of the board","Die Spalten sind von der anderen Seite der Tafel gezählt"],["check the length unit of [touches], the same for every column, and that they are in the robot's base","Die Längeneinheit der Antastungen prüfen, und dass sie in der Basis des Roboters sind"],["check corner ids and frame of the touches, and which placement each belongs to","Die Nummern der Ecken und das Koordinatensystem der Antastungen prüfen, und zu welcher hingelegten Tafel jede gehört"],["images and touches disagree by {mm} mm (p = {p}). The likeliest cause is a wrong tool tip: the true one is the declared one plus ({offset~}) mm in the |flange| frame. The result uses the corrected tip; calibrate the tool again{more*}","Bilder und Antastungen weichen um {mm} mm voneinander ab (p = {p}). Am wahrscheinlichsten ist eine falsche Werkzeugspitze: Die wahre ist die angegebene plus ({offset~}) mm im Flansch. Das Ergebnis rechnet mit der berichtigten Spitze; das Werkzeug neu kalibrieren{more*}"],["images and touches disagree by {mm} mm (p = {p}). The likeliest cause is a wrong tool tip: the true one is the declared one plus ({offset~}) mm in the |flange| frame. The result uses the corrected tip; calibrate the tool again","Bilder und Antastungen weichen um {mm} mm voneinander ab (p = {p}). Am wahrscheinlichsten ist eine falsche Werkzeugspitze: Die wahre ist die angegebene plus ({offset~}) mm im Flansch. Das Ergebnis rechnet mit der berichtigten Spitze; das Werkzeug neu kalibrieren"],[". But {mm} mm is {squares*} of the board: if the corner ids start at another corner, correct the ids; the tip is right then",". Aber {mm} mm sind {squares*} der Tafel: Beginnen die Nummern an einer anderen Ecke, die Nummern berichtigen; die Spitze stimmt dann"],["one square","ein Feld"],["{count} squares","{count} Felder"],["images and touches disagree (p = {p}), and a wrong tool tip does not explain it. Possible causes: the robot's error where it touched differs from that at the captures; images and robot poses were not taken at the same time; images and scans are not aligned. The result is valid near the touched points only","Bilder und Antastungen weichen voneinander ab (p = {p}), und eine falsche Werkzeugspitze erklärt es nicht. Mögliche Ursachen: Der Fehler des Roboters ist beim Antasten ein anderer als bei den Aufnahmen; Bilder und Posen sind nicht gleichzeitig; Bilder und Scans liegen nicht aufeinander. Das Ergebnis gilt nur nahe den angetasteten Punkten"],["the answer corrects the tool's tip by {mm} mm","Das Ergebnis berichtigt die Werkzeugspitze um {mm} mm"],["the answer corrects the tool's tip","Das Ergebnis berichtigt die Werkzeugspitze"],["calibrate the tool again (`handeye tcp`)","Das Werkzeug neu kalibrieren (`handeye tcp`)"],["images and touches disagree, and the result is valid near the touched points only","Bilder und Antastungen weichen voneinander ab, und das Ergebnis gilt nur nahe den angetasteten Punkten"],["touch corners in the work area, and check the alignment of images and scans and their time stamps","Ecken im Arbeitsbereich antasten, und die Ausrichtung von Bildern und Scans und ihre Zeiten prüfen"],["no {candidate~} candidate: {why*}","Kein Kandidat {candidate~}: {why*}"],["{found} point pairs, at least {needed} are needed","{found} Punktpaare, mindestens {needed} sind nötig"],["the points lie on one line (spread across it is {ratio} of the spread along it): the rotation about that line is not determined; add points away from it","Die Punkte liegen auf einer Geraden (quer dazu {ratio} der Ausdehnung längs): Die Drehung um diese Gerade ist nicht bestimmt; Punkte abseits davon ergänzen"],["the points lie nearly on one line (their spread across it is {ratio} % of that along it): the rotation about that line is poorly determined; add points away from it","Die Punkte liegen fast auf einer Geraden (quer dazu {ratio} % der Ausdehnung längs): Die Drehung um diese Gerade ist schlecht bestimmt; Punkte abseits davon ergänzen"],["placement {id}: |1 touch| not used (corner {corners~}): {why*}","Hingelegte Tafel {id}: 1 Antastung nicht verwendet (Ecke {corners~}): {why*}"],["placement {id}: {count} touches| not used (corner {corners~}): {why*}","Hingelegte Tafel {id}: {count} Antastungen nicht verwendet (Ecke {corners~}): {why*}"],["its image shows no target ({why*}); take it again, or another one","Ihr Bild zeigt keine Tafel ({why*}); noch einmal aufnehmen, oder ein anderes"],['the touch of corner {corner} of "{placement}"| is listed {count} times with the same numbers and counts once: touch the corner anew for a second measurement',"Die Antastung der Ecke {corner} von „{placement}“ kommt {count}-mal mit denselben Zahlen vor und zählt einmal: Für eine zweite Messung die Ecke neu antasten"],["the images do not determine {what*}: only the touches do, and nothing checks them; tilt the robot about a second axis if it can","Die Bilder bestimmen nicht: {what*}. Das tun nur die Antastungen, und nichts prüft sie; den Roboter um eine zweite Achse neigen, wenn er kann"],["view {number} does not fit the others and was rejected","Ansicht {number} passt nicht zu den anderen und wurde verworfen"],["view {number} has {px} px rms, the others {typical} px: is it blurred?","Ansicht {number} hat {px} px RMS, die anderen {typical} px: Ist sie unscharf?"],["no diameter_mm given: {count} scans find {mm} mm (median, from {least} to {most}); set `target.diameter_mm` to the measured value for more accurate centres","Kein Durchmesser angegeben: {count} Scans finden {mm} mm (Median, von {least} bis {most}); den gemessenen angeben, dann sind die Mitten genauer"],["the answer uses a board that is longer or shorter along y, not the declared one","Das Ergebnis rechnet mit einer Tafel, die entlang y länger oder kürzer ist, nicht mit der angegebenen"],["the answer uses a bent board, not a flat one","Das Ergebnis rechnet mit einer gebogenen Tafel, nicht mit einer ebenen"],["depth on black was corrected to that on white","Die Tiefe auf Schwarz wurde auf die von Weiß berichtigt"],["depth on black, off by {mm} mm, was corrected to that on white","Die Tiefe auf Schwarz, um {mm} mm falsch, wurde auf die von Weiß berichtigt"],["take a board of matt grey and white","Eine Tafel in mattem Grau und Weiß nehmen"],["the answer corrects the depth of the scans ({share} %, {mm} mm)","Das Ergebnis berichtigt die Tiefe der Scans ({share} %, {mm} mm)"],["the answer corrects the depth of the scans","Das Ergebnis berichtigt die Tiefe der Scans"],["correct the points of this camera as `depth` says, or have its depth calibrated","Die Punkte dieser Kamera berichtigen, wie `depth` sagt, oder ihre Tiefe kalibrieren lassen"],["the depth of the scans is off by {share} +- {sigma} % and {bias} +- {error} mm: the answer corrects it, and the points of this camera must be corrected too, {formula~}; let it warm up, and calibrate its depth","Die Tiefe der Scans ist um {share} +- {sigma} % und {bias} +- {error} mm falsch: Das Ergebnis berichtigt sie, und auch die Punkte dieser Kamera müssen berichtigt werden, {formula~}; sie warmlaufen lassen und ihre Tiefe kalibrieren"],["the scans measure black {mm} +- {sigma} mm {which*} than white (noise of a corner: {noise} mm)","Die Scans messen Schwarz {mm} +- {sigma} mm {which*} als Weiß (Rauschen einer Ecke: {noise} mm)"],["points on black were corrected","Punkte auf Schwarz wurden berichtigt"],["A flat board cannot tell which colour is right: the depth on white is the reference, and the result is valid for surfaces that the camera measures like white","Eine ebene Tafel sagt nicht, welche Farbe stimmt: Maßgebend ist die Tiefe auf Weiß, und das Ergebnis gilt für Oberflächen, die die Kamera wie Weiß misst"],["images and scans disagree, and the answer is for the frame of the |images","Bilder und Scans weichen voneinander ab, und das Ergebnis gilt für das Koordinatensystem der Bilder"],["images and scans disagree, and the answer is for the frame of the |scans","Bilder und Scans weichen voneinander ab, und das Ergebnis gilt für das Koordinatensystem der Scans"],["images and scans disagree, and the answer is for the frame of one of them","Bilder und Scans weichen voneinander ab, und das Ergebnis gilt für das Koordinatensystem von einem davon"],["images and scans disagree in scale","Bilder und Scans weichen im Maßstab voneinander ab"],["images and scans disagree in rotation","Bilder und Scans sind gegeneinander gedreht"],["images and scans disagree in position","Bilder und Scans sind gegeneinander verschoben"],["check focal length, size of the target and scale of depth","Brennweite, Größe der Tafel und Maßstab der Tiefe prüfen"],["use the point cloud that is registered to the image (the same optical frame)","Die Punktwolke verwenden, die auf das Bild ausgerichtet ist (dasselbe optische Koordinatensystem)"],["check the calibration between image and depth, and the frame of the points","Die Kalibrierung zwischen Bild und Tiefe und das Koordinatensystem der Punkte prüfen"],["images and scans put the target at different positions, and these captures do not tell whether the scans are scaled, rotated or shifted","Bilder und Scans sehen die Tafel an verschiedenen Orten, und diese Aufnahmen sagen nicht, ob die Scans einen anderen Maßstab haben, gedreht oder verschoben sind"],["show the target at several distances and tilts, and check the calibration between image and scan","Die Tafel in mehreren Entfernungen und Neigungen zeigen und die Kalibrierung zwischen Bild und Scan prüfen"],["scans put the target {value} +- {sigma} % farther away than images do: the focal length, the size of the target or the scale of depth is wrong; only the robot's motions can tell which","Scans sehen die Tafel {value} +- {sigma} % weiter weg als Bilder: Brennweite, Größe der Tafel oder Maßstab der Tiefe ist falsch; welches, sagen nur die Bewegungen des Roboters"],["capture {id}: {missing} of {all} corners have no point in the scan (corner {corner}: {why*})","Aufnahme {id}: {missing} von {all} Ecken haben keinen Punkt im Scan (Ecke {corner}: {why*})"],["{what*}; it also looks like {effects*}, no farther off than this explains, and the answer takes that into account: correct this first","{what*}; es sieht auch aus wie {effects*}, nicht weiter, als dies erklärt, und das Ergebnis berücksichtigt es: Dies zuerst berichtigen"],["outside of the scan","außerhalb des Scans"],["a hole: only {count} points of {all} around it","ein Loch: nur {count} Punkte von {all} darum"],["a depth edge: only {share} % of the points around it lie in one plane","eine Tiefenkante: nur {share} % der Punkte darum liegen in einer Ebene"],["points on one side of it only","Punkte nur auf einer Seite"],["too few points away from the edges of the print: the scan is too coarse","zu wenige Punkte abseits der Kanten des Drucks: Der Scan ist zu grob"],["the scan is not a grid as large as the image, and no intrinsics are known","Der Scan ist kein Gitter so groß wie das Bild, und keine Intrinsik ist bekannt"],["other intrinsics than the given ones","eine andere Intrinsik als die angegebene"],["depth that is off","falsche Tiefe"],["scans of another scale than images","Scans in anderem Maßstab als Bilder"],["scans rotated against images","gegen die Bilder gedrehte Scans"],["scans shifted against images","gegen die Bilder verschobene Scans"]];var Ah=/\{(\w+)([*~]?)\}/g,al=n=>n.replace(/[.*+?^${}()|[\]\\]/g,"\\$&"),ol=n=>n.replace(/\.$/,"");function cp(n,e){let t=ol(n.replaceAll("|","")),i=t.split(/\{\w+[*~]?\}/),s=[...t.matchAll(Ah)].map(([,c,l])=>`${c}${l}`),r=i[0]??"",a=/^[a-z]/i.test(r)?`[${r.charAt(0).toLowerCase()}${r.charAt(0).toUpperCase()}]${al(r.slice(1))}`:al(r),o=i.slice(1).map((c,l)=>`${/[*~]$/.test(s[l]??"")?"(.+?)":"(\\S+?)"}${al(c)}`);return{pattern:new RegExp(`^${a}${o.join("")}$`,"s"),longest:i.map((c,l)=>l===0?c.slice(1):c).reduce((c,l)=>l.length>c.length?l:c),names:s,german:ol(e),size:i.join("").length}}var hp=Sh.map(([n,e])=>cp(n,e)).sort((n,e)=>e.size-n.size),up=n=>n.charAt(0).toUpperCase()+n.slice(1),dp=new Set(`
  Ab Aber Alle Als Am An Auch Auf Aufgenommen Aus Bei Beide Bestätigen Bis Da Danach Darauf Darin Das Dasselbe Davon Den
  Der Des Die Dies Diese Dieser Dieses Dort Dorthin Ein Eine Einem Einen Einer Eins Entweder Er Erst Es Etwas Für
  Genug Geprüft Geschrieben Herausfinden Hier Hingelegte Höchstens Ihr Ihre Im In Ist Jetzt Kein Keine Mehr Mit Nach
  Maßgebend Neben Nicht Nichts Noch Nur Oder Ohne Seine Seit Sich Sie Siehe Sind Startet Steckt Stimmen Um Und Viele
  Vielleicht Vom Von Vor Vorhergesagter Warmlaufen Warte Was Welche Wenn Wie Wiederholt Wo Zu Zum Zur Zwischen
  `.split(/\s+/));function fp(n,e,t){if(/[:(] ?$/.test(t))return n;if(/^\p{Lu}/u.test(e))return up(n);let i=/^\p{L}+/u.exec(n)?.[0]??"";return dp.has(i)?n.charAt(0).toLowerCase()+n.slice(1):n}function Mh(n,e){let t=ol(n);for(let{pattern:i,longest:s,names:r,german:a}of hp){if(!t.includes(s))continue;let o=i.exec(t);if(!o)continue;let c=new Map(r.map((d,h)=>[d,o[h+1]??""])),l=a.replace(Ah,(d,h,f,g)=>{let x=c.get(h+f)??d;return f==="*"?ll(x,e+a.slice(0,g)):x}),u=fp(l,t,e);return n.endsWith(".")&&!/[.!?…:]$/.test(u)?`${u}.`:u}return null}var pp=/([.?;:]|, and|, or|,) /g,mp={", and":", und",", or":", oder"},gp=24;function ll(n,e=""){let t=Mh(n,e);if(t!==null)return t;let i=[...n.matchAll(pp)].slice(0,gp),s=(o,c)=>{let l=o[1]??"",u=l==="."||l==="?",d=c??n.slice(0,o.index)+(u?l:""),h=u?`${d} `:`${d}${mp[l]??l} `;return h+ll(n.slice(o.index+o[0].length),e+h)};for(let o of[...i].reverse()){let c=o[1]??"",l=Mh(n.slice(0,o.index)+(c==="."||c==="?"?c:""),e);if(l!==null)return s(o,l)}let r=i.find(([,o])=>o!==",");if(!r)return n;let a=s(r,null);return a.endsWith(n.slice(r.index+r[0].length))?n:a}var _p=300,Gs=new Map;function Th(n){let e=Gs.get(n);if(e!==void 0)return e;Gs.size>=_p&&Gs.delete(Gs.keys().next().value);let t=ll(n);return Gs.set(n,t),t}var ts="en";function Bi(){return ts}function ne(n,e={}){let[t,i]=wh[n];return(ts==="de"?i:t).replace(/\{(\w+)\}/g,(s,r)=>String(e[r]??s))}function Ut(n){let e=n.trim(),i=/^(?!f[xy]\b|c[xy]\b)[a-z]+(?=[ ,:;.]|$)/.test(e)?e.charAt(0).toUpperCase()+e.slice(1):e;return/[.!?…:]$/.test(i)?i:`${i}.`}function Ln(n){return ts==="de"?Th(n):n}var bp=/[a-z]{3}/i;function lt(n,e,t=s=>s,i="; "){let s=typeof e=="string"?[e]:e??[],r=s.map(Ln),a=ts!=="en"&&r.join()===s.join()&&bp.test(r.join());Ee(n,r.length?t(r.join(i)):""),Pe(n,"lang",a&&"en")}function Yt(n,e){Ee(n,e),Pe(n,"lang",null)}function Me(n,e){return n.getAttribute("data-say")!==e&&(n.setAttribute("data-say",e),n.textContent=ne(e)),n}function bt(n,e,t=!1){return n.getAttribute("data-name")!==e&&(n.setAttribute("data-name",e),t&&n.setAttribute("data-tooltip",""),Eh(n)),n}function Eh(n){let e=ne(n.getAttribute("data-name"));n.setAttribute("aria-label",e),n.hasAttribute("data-tooltip")&&n.setAttribute("title",e)}function Rh(n){if(n!==ts){ts=n,document.documentElement.lang=n;for(let e of document.querySelectorAll("[data-say]"))e.textContent=ne(e.getAttribute("data-say"));document.querySelectorAll("[data-name]").forEach(Eh)}}function Ke(n,e,t={}){let i=R("button",{type:"button",class:t.class});return i.addEventListener("click",s=>{s.detail>0&&i.blur(),e()}),t.icon&&i.append(Pt(t.icon)),t.bare?bt(i,n,!0):i.append(Me(R("span"),n)),i}function ft(n,...e){return R("section",{class:"card"},Me(R("h2"),n),...e)}function Kn(n,e){return R("label",{class:"labelled"},Me(R("span"),n),e)}function ns(){let[n,e]=[Pt("lock"),R("span")],t=R("p",{class:"fixed-by"},n,e);return{element:t,update(i){let s=qn(i)??(i.captures?.length?"read_again":null);fe(t,s!==null),on(n,s==="read_again"?"again":"lock"),s&&Me(e,s)}}}function tt(n){if(n==null||!Number.isFinite(n))return"–";let e=Math.abs(n);return n.toFixed(e<.1?3:e<10?2:e<100?1:0)}function Vr(n){if(n==null||!Number.isFinite(n))return"–";let e=Math.abs(n);return n.toFixed(e<.01?4:e<.1?3:e<10?2:1)}var xp={ur:["m","rad"],"ur-rpy":["m","rad"],kuka:["mm","°"],fanuc:["mm","°"],abb:["mm",""],yaskawa:["mm","°"],kawasaki:["mm","°"],staubli:["mm","°"],doosan:["mm","°"],denso:["mm","°"]},vp={m:5,mm:2,rad:4,"°":3,deg:3};function Ch(n,e,t,i){let[s,r]=xp[t??""]??["",""];return Array.from({length:e},(a,o)=>{let c=n?.[o]??String(o+1),[,l,u]=/^(.*?)_(mm|m|deg|rad)$/.exec(c)??[null,c,null],d=i?.[o]??u??(e===16?"":o<3?s:r);return{name:l??c,unit:d==="deg"?"°":d,digits:vp[d]??5}})}function Lh(){let n=R("span",{class:"fill"}),e=R("div",{class:"tolerance",role:"img"},n,R("span",{class:"limit"}));return{element:e,update(t,i,s){let r=typeof t=="number"&&i?t/(2*i):null;zs(n,r===null?0:Math.max(1.5,100*r)),Ne(e,"good",r!==null&&r<=.5),Ne(e,"over",r!==null&&r>.5),Pe(e,"aria-label",s)}}}var[Hr,Vs]=[300,74],[Wr,cl,yp,Ph]=[8,8,10,20],wp=4;function Nh(){let n=_t("path",{class:"curve"}),e=_t("path",{class:"limit"}),t=_t("g"),i=_t("text",{class:"axis",x:Wr,y:Vs-4}),s=_t("text",{class:"axis",x:Hr-cl,y:Vs-4,"text-anchor":"end"}),r=_t("svg",{viewBox:`0 0 ${Hr} ${Vs}`,class:"history",role:"img"},e,n,t,i,s),a="";return{element:r,update(o,c){let l=o.filter(S=>typeof S[1]=="number"),u=JSON.stringify([l,c,ne("captures")]);if(fe(r,l.length>1),u===a)return;a=u;let[d,h]=[l[0],l[l.length-1]];if(!d||!h)return;let f=Math.max(...l.map(([,S])=>S)),g=c?Math.min(f,wp*c,Math.max(f,1.2*c)):f,x=c?Math.max(g,1.2*c):g,m=S=>Wr+(Hr-Wr-cl)*(S-d[0])/Math.max(1,h[0]-d[0]),p=S=>Vs-Ph-(Vs-yp-Ph)*Math.min(S,x)/x;Pe(n,"d",l.map(([S,w],T)=>`${T?"L":"M"}${m(S).toFixed(1)} ${p(w).toFixed(1)}`).join("")),Pe(e,"d",c?`M${Wr} ${p(c).toFixed(1)}H${Hr-cl}`:""),t.replaceChildren(...l.map(([S,w])=>_t("circle",{cx:m(S),cy:p(w),r:3,class:c&&w<=c?"good":""},_t("title",{},`${S}: ${tt(w)} mm`)))),Ee(i,ne("captures_count",{count:d[0]})),Ee(s,ne("captures_count",{count:h[0]}));let v=l.map(([S,w])=>`${S}: ${tt(w)} mm`).join(", ");Pe(r,"aria-label",ne("history_label",{points:v}))}}}function Ih(n){return n.startsWith("about ")?ne("about_axis",{axis:n.slice(6)}):n}function Fh(){let n=R("dl",{class:"directions"}),e=[],t=ut(n,i=>i.name,()=>{let[i,s,r]=[R("dt"),R("span",{class:"fill"}),R("b")],a=R("span",{class:"bar","aria-hidden":"true"},s),o=R("div",{class:"direction"},i,R("dd",{},a,r));return{element:o,update(c){let l=typeof c.sigma=="number",u=Math.max(...e.filter(({unit:h})=>h===c.unit).map(({sigma:h})=>h??0));Ee(i,Ih(c.name)),zs(s,l&&u>0?100*c.sigma/u:100),Ne(o,"unknown",!l);let d=c.unit==="deg"?"°":` ${c.unit??""}`;Ee(r,l?`${Vr(c.sigma)}${d}`:"?"),Pe(o,"title",l?null:ne("unknown_direction",{direction:Ih(c.name)}))}}});return{element:n,update(i){e=i;let[s,r]=[i.filter(Dh),i.filter(a=>!Dh(a))];t(s.flatMap((a,o)=>[a,r[o]]).concat(r.slice(s.length)).filter(a=>a!==void 0))}}}var Dh=n=>n.unit!=="deg";function Sp(n){let e=n.progress;return e?e.verdict==="rejected"?ne("verdict_rejected"):typeof e.p95_mm!="number"?ne("verdict_undetermined"):Oi(n)?ne("verdict_enough"):ne("verdict_more"):ne("no_progress")}function Uh(n){let e=R("b"),t=R("span",{class:"unit"},"mm"),i=R("small"),s=R("p",{class:"verdict"}),[r,a,o]=[Lh(),Nh(),Fh()],c=Me(R("small",{class:"working"}),"assessing"),l=Me(R("h3"),"six_directions"),u=R("p",{class:"undetermined"}),d=R("p",{class:"truth"}),h=R("button",{type:"button",class:"below"});h.addEventListener("click",()=>document.getElementById("grave")?.scrollIntoView({block:"nearest"}));let f=Ke("finish_now",()=>{n.send({do:"finish"})}),g=R("section",{class:"card accuracy"},Me(R("h2"),"accuracy"),R("div",{class:"number"},e,t,s),r.element,R("div",{class:"allowed"},i,c),h,a.element,l,o.element,u,d,f);return{element:g,update(x){let m=x.progress,p=m?.tolerance_mm??x.cell?.tolerance_mm,v=m?.p95_mm,S=m?.verdict==="rejected";Ee(e,tt(v)),Ee(i,p?ne("of_tolerance",{tolerance:tt(p)}):""),r.update(v,p,ne("error_label",{error:tt(v),tolerance:tt(p)})),Ee(s,Sp(x)),Ne(g,"good",Oi(x)),Ne(g,"bad",S),a.update(m?.history??[],p),o.update(m?.directions??[]),fe(l,!!m?.directions?.length);let w=(m?.findings??[]).filter(({severity:_})=>_==="changes-answer").length;Ee(h,ne("findings_below",{count:w})),fe(h,w>0);let T=m?.undetermined??[];Ee(u,T.length?ne("undetermined_list",{list:T.map(Ln).join(", ")}):""),fe(u,T.length>0);let A=x.virtual_cell?.truth_error_mm;Ee(d,typeof A=="number"?ne("truth_error",{mm:tt(A)}):""),fe(d,typeof A=="number"),Ne(c,"idle",!x.assessing),fe(f,x.step==="capture"&&bh(x)&&!Oi(x))}}}var kh=1;function Mp(n,e){let t=R("span",{class:"fill"}),[i,s,r]=[R("b"),R("small"),R("p",{class:"reason"})],a=Pt("warning"),o=R("button",{type:"button",class:"capture"},R("span",{class:"id"},e),R("span",{class:"bar","aria-hidden":"true"},t),a,i,s);o.addEventListener("click",d=>{d.detail>0&&o.blur(),n.choose({selected:n.choices.selected===e?null:e,large:"picture"})});let c=R("div",{class:"tools"},Ke("delete",()=>{n.send({do:"delete",id:e})},{icon:"bin"}),Ke("retake",()=>{n.send({do:"retake",id:e})},{icon:"again"})),l=R("li",{},o,r,c),u=!1;return{element:l,update(d){let h=n.choices.selected===e,f=vn(d),g=d.residual_mm;zs(t,typeof g=="number"?100*g/kh:0),Ee(i,typeof g=="number"?`${tt(g)} mm`:ne(f?"not_used":"no_residual")),Ee(s,typeof d.residual_px=="number"?`${tt(d.residual_px)} px`:""),lt(r,d.reason,Ut),fe(r,!!d.reason&&(h||f)),fe(a,f),fe(c,h),Ne(l,"outlier",f),Ne(l,"selected",h),Pe(o,"aria-pressed",String(h)),h&&!u&&l.scrollIntoView({block:"nearest"}),u=h}}}function Oh(n){let e=R("span",{class:"count"}),t=Ke("undo",()=>{n.send({do:"undo"})},{icon:"undo"}),i=R("ol",{class:"captures"}),s=Me(R("p",{class:"none"}),"no_captures"),r=R("ul",{class:"deleted"}),a=ut(i,l=>l.id,l=>Mp(n,l.id)),o=ut(r,({id:l})=>l,({id:l})=>{let u=R("span"),d=Ke("restore",()=>{n.send({do:"restore",id:l})},{icon:"undo"});return{element:R("li",{},u,d),update:()=>Ee(u,ne("deleted_id",{id:l}))}});return{element:R("section",{class:"card list"},R("div",{class:"top"},R("h2",{},Me(R("span"),"captures")," ",e),t),s,i,r),update(l){let u=l.captures??[],d=u.filter(h=>!vn(h)).map(({residual_mm:h})=>h??0);kh=Math.max(l.cell?.tolerance_mm??0,...d,1e-6),Ee(e,String(u.length)),fe(e,u.length>0),fe(s,u.length===0),fe(t,!!l.can_undo),Pe(t,"title",l.can_undo&&Ln(l.can_undo)),a([...u].reverse()),o((l.deleted??[]).filter(({id:h})=>!/^[pt]/.test(h)))}}}/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */var du=0,zl=1,fu=2;var gr=1,pu=2,As=3,Ti=0,Qt=1,sn=2,qi=0,Ts=1,Gl=2,Vl=3,Hl=4,mu=5;var Ki=100,gu=101,_u=102,bu=103,xu=104,vu=200,yu=201,wu=202,Su=203,Wl=204,Xl=205,Mu=206,Au=207,Tu=208,Eu=209,Ru=210,Cu=211,Pu=212,Iu=213,Du=214,ma=0,ga=1,_a=2,_s=3,ba=4,xa=5,va=6,ya=7,Za=0,Lu=1,Nu=2,Bn=0,ql=1,Kl=2,Yl=3,Zl=4,$l=5,Jl=6,jl=7;var Ql=300,Yi=301,Es=302,$a=303,Ja=304,wa=1e3,Fn=1001,Sa=1002,St=1003,Fu=1004;var _r=1005;var Jt=1006,ja=1007;var ri=1008;var rn=1009,ec=1010,tc=1011,Rs=1012,Qa=1013,An=1014,Tn=1015,En=1016,eo=1017,to=1018,Zi=1020,nc=35902,ic=35899,sc=1021,rc=1022,Rn=1023,ei=1026,ai=1027,ac=1028,no=1029,Ei=1030,io=1031;var so=1033,br=33776,xr=33777,vr=33778,yr=33779,ro=35840,ao=35841,oo=35842,lo=35843,co=36196,ho=37492,uo=37496,fo=37488,po=37489,wr=37490,mo=37491,go=37808,_o=37809,bo=37810,xo=37811,vo=37812,yo=37813,wo=37814,So=37815,Mo=37816,Ao=37817,To=37818,Eo=37819,Ro=37820,Co=37821,Po=36492,Io=36494,Do=36495,Lo=36283,No=36284,Sr=36285,Fo=36286;var Zs=2300,Ma=2301,fa=2302,Ll=2303,Nl=2400,Fl=2401,Ul=2402;var Uu=3200;var Uo=0,ku=1,oi="",Zt="srgb",$s="srgb-linear",Js="linear",it="srgb";var pa=7680;var Ou=519,Bu=512,zu=513,Gu=514,oc=515,Vu=516,Hu=517,lc=518,cc=519,Wu=35044;var hc="300 es",_n=2e3,bs=2001;function Ap(n){for(let e=n.length-1;e>=0;--e)if(n[e]>=65535)return!0;return!1}function Tp(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function js(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function Xu(){let n=js("canvas");return n.style.display="block",n}var Bh={},xs=null;function uc(...n){let e="THREE."+n.shift();xs?xs("log",e,...n):console.log(e,...n)}function qu(n){let e=n[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=n[1];t&&t.isStackTrace?n[0]+=" "+t.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Le(...n){n=qu(n);let e="THREE."+n.shift();if(xs)xs("warn",e,...n);else{let t=n[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...n)}}function Ue(...n){n=qu(n);let e="THREE."+n.shift();if(xs)xs("error",e,...n);else{let t=n[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...n)}}function Ys(...n){let e=n.join(" ");e in Bh||(Bh[e]=!0,Le(...n))}function Ku(n,e,t){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(e,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:i()}}setTimeout(r,t)})}var Yu={[ma]:ma,[_a]:va,[ba]:ba,[_s]:xa,[ga]:ga,[va]:_a,[ya]:ya,[xa]:_s},kn=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[e]===void 0&&(i[e]=[]),i[e].indexOf(t)===-1&&i[e].push(t)}hasEventListener(e,t){let i=this._listeners;return i===void 0?!1:i[e]!==void 0&&i[e].indexOf(t)!==-1}removeEventListener(e,t){let i=this._listeners;if(i===void 0)return;let s=i[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let i=t[e.type];if(i!==void 0){e.target=this;let s=i.slice(0);for(let r=0,a=s.length;r<a;r++)s[r].call(this,e);e.target=null}}},Wt=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var hl=Math.PI/180,Aa=180/Math.PI;function Mr(){let n=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Wt[n&255]+Wt[n>>8&255]+Wt[n>>16&255]+Wt[n>>24&255]+"-"+Wt[e&255]+Wt[e>>8&255]+"-"+Wt[e>>16&15|64]+Wt[e>>24&255]+"-"+Wt[t&63|128]+Wt[t>>8&255]+"-"+Wt[t>>16&255]+Wt[t>>24&255]+Wt[i&255]+Wt[i>>8&255]+Wt[i>>16&255]+Wt[i>>24&255]).toLowerCase()}function Qe(n,e,t){return Math.max(e,Math.min(t,n))}function Ep(n,e){return(n%e+e)%e}function ul(n,e,t){return(1-t)*n+t*e}function Zu(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function dc(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Rp(n,e){if(e.constructor===Float32Array)return n;let t=dc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/t,-1)}function Cp(n,e){if(e.constructor===Float32Array)return n;let t=dc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*t)}var je=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,i=this.y,s=e.elements;return this.x=s[0]*t+s[3]*i+s[6],this.y=s[1]*t+s[4]*i+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=Qe(this.x,e.x,t.x),this.y=Qe(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=Qe(this.x,e,t),this.y=Qe(this.y,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Qe(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(Qe(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y;return t*t+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let i=Math.cos(t),s=Math.sin(t),r=this.x-e.x,a=this.y-e.y;return this.x=r*i-a*s+e.x,this.y=r*s+a*i+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},bn=class{constructor(e=0,t=0,i=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=i,this._w=s}static slerpFlat(e,t,i,s,r,a,o){let c=i[s+0],l=i[s+1],u=i[s+2],d=i[s+3],h=r[a+0],f=r[a+1],g=r[a+2],x=r[a+3];if(d!==x||c!==h||l!==f||u!==g){let m=c*h+l*f+u*g+d*x;m<0&&(h=-h,f=-f,g=-g,x=-x,m=-m);let p=1-o;if(m<.9995){let v=Math.acos(m),S=Math.sin(v);p=Math.sin(p*v)/S,o=Math.sin(o*v)/S,c=c*p+h*o,l=l*p+f*o,u=u*p+g*o,d=d*p+x*o}else{c=c*p+h*o,l=l*p+f*o,u=u*p+g*o,d=d*p+x*o;let v=1/Math.sqrt(c*c+l*l+u*u+d*d);c*=v,l*=v,u*=v,d*=v}}e[t]=c,e[t+1]=l,e[t+2]=u,e[t+3]=d}static multiplyQuaternionsFlat(e,t,i,s,r,a){let o=i[s],c=i[s+1],l=i[s+2],u=i[s+3],d=r[a],h=r[a+1],f=r[a+2],g=r[a+3];return e[t]=o*g+u*d+c*f-l*h,e[t+1]=c*g+u*h+l*d-o*f,e[t+2]=l*g+u*f+o*h-c*d,e[t+3]=u*g-o*d-c*h-l*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,i,s){return this._x=e,this._y=t,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let i=e._x,s=e._y,r=e._z,a=e._order,o=Math.cos,c=Math.sin,l=o(i/2),u=o(s/2),d=o(r/2),h=c(i/2),f=c(s/2),g=c(r/2);switch(a){case"XYZ":this._x=h*u*d+l*f*g,this._y=l*f*d-h*u*g,this._z=l*u*g+h*f*d,this._w=l*u*d-h*f*g;break;case"YXZ":this._x=h*u*d+l*f*g,this._y=l*f*d-h*u*g,this._z=l*u*g-h*f*d,this._w=l*u*d+h*f*g;break;case"ZXY":this._x=h*u*d-l*f*g,this._y=l*f*d+h*u*g,this._z=l*u*g+h*f*d,this._w=l*u*d-h*f*g;break;case"ZYX":this._x=h*u*d-l*f*g,this._y=l*f*d+h*u*g,this._z=l*u*g-h*f*d,this._w=l*u*d+h*f*g;break;case"YZX":this._x=h*u*d+l*f*g,this._y=l*f*d+h*u*g,this._z=l*u*g-h*f*d,this._w=l*u*d-h*f*g;break;case"XZY":this._x=h*u*d-l*f*g,this._y=l*f*d-h*u*g,this._z=l*u*g+h*f*d,this._w=l*u*d+h*f*g;break;default:Le("Quaternion: .setFromEuler() encountered an unknown order: "+a)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let i=t/2,s=Math.sin(i);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,i=t[0],s=t[4],r=t[8],a=t[1],o=t[5],c=t[9],l=t[2],u=t[6],d=t[10],h=i+o+d;if(h>0){let f=.5/Math.sqrt(h+1);this._w=.25/f,this._x=(u-c)*f,this._y=(r-l)*f,this._z=(a-s)*f}else if(i>o&&i>d){let f=2*Math.sqrt(1+i-o-d);this._w=(u-c)/f,this._x=.25*f,this._y=(s+a)/f,this._z=(r+l)/f}else if(o>d){let f=2*Math.sqrt(1+o-i-d);this._w=(r-l)/f,this._x=(s+a)/f,this._y=.25*f,this._z=(c+u)/f}else{let f=2*Math.sqrt(1+d-i-o);this._w=(a-s)/f,this._x=(r+l)/f,this._y=(c+u)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let i=e.dot(t)+1;return i<1e-8?(i=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=i):(this._x=0,this._y=-e.z,this._z=e.y,this._w=i)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=i),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(Qe(this.dot(e),-1,1)))}rotateTowards(e,t){let i=this.angleTo(e);if(i===0)return this;let s=Math.min(1,t/i);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let i=e._x,s=e._y,r=e._z,a=e._w,o=t._x,c=t._y,l=t._z,u=t._w;return this._x=i*u+a*o+s*l-r*c,this._y=s*u+a*c+r*o-i*l,this._z=r*u+a*l+i*c-s*o,this._w=a*u-i*o-s*c-r*l,this._onChangeCallback(),this}slerp(e,t){let i=e._x,s=e._y,r=e._z,a=e._w,o=this.dot(e);o<0&&(i=-i,s=-s,r=-r,a=-a,o=-o);let c=1-t;if(o<.9995){let l=Math.acos(o),u=Math.sin(l);c=Math.sin(c*l)/u,t=Math.sin(t*l)/u,this._x=this._x*c+i*t,this._y=this._y*c+s*t,this._z=this._z*c+r*t,this._w=this._w*c+a*t,this._onChangeCallback()}else this._x=this._x*c+i*t,this._y=this._y*c+s*t,this._z=this._z*c+r*t,this._w=this._w*c+a*t,this.normalize();return this}slerpQuaternions(e,t,i){return this.copy(e).slerp(t,i)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},F=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,i=0){this.x=e,this.y=t,this.z=i}set(e,t,i){return i===void 0&&(i=this.z),this.x=e,this.y=t,this.z=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(zh.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(zh.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*i+r[6]*s,this.y=r[1]*t+r[4]*i+r[7]*s,this.z=r[2]*t+r[5]*i+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=e.elements,a=1/(r[3]*t+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*i+r[8]*s+r[12])*a,this.y=(r[1]*t+r[5]*i+r[9]*s+r[13])*a,this.z=(r[2]*t+r[6]*i+r[10]*s+r[14])*a,this}applyQuaternion(e){let t=this.x,i=this.y,s=this.z,r=e.x,a=e.y,o=e.z,c=e.w,l=2*(a*s-o*i),u=2*(o*t-r*s),d=2*(r*i-a*t);return this.x=t+c*l+a*d-o*u,this.y=i+c*u+o*l-r*d,this.z=s+c*d+r*u-a*l,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*i+r[8]*s,this.y=r[1]*t+r[5]*i+r[9]*s,this.z=r[2]*t+r[6]*i+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=Qe(this.x,e.x,t.x),this.y=Qe(this.y,e.y,t.y),this.z=Qe(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=Qe(this.x,e,t),this.y=Qe(this.y,e,t),this.z=Qe(this.z,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Qe(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let i=e.x,s=e.y,r=e.z,a=t.x,o=t.y,c=t.z;return this.x=s*c-r*o,this.y=r*a-i*c,this.z=i*o-s*a,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let i=e.dot(this)/t;return this.copy(e).multiplyScalar(i)}projectOnPlane(e){return dl.copy(this).projectOnVector(e),this.sub(dl)}reflect(e){return this.sub(dl.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(Qe(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y,s=this.z-e.z;return t*t+i*i+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,i){let s=Math.sin(t)*e;return this.x=s*Math.sin(i),this.y=Math.cos(t)*e,this.z=s*Math.cos(i),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,i){return this.x=e*Math.sin(t),this.y=i,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),i=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=i,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,i=Math.sqrt(1-t*t);return this.x=i*Math.cos(e),this.y=t,this.z=i*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},dl=new F,zh=new bn,ke=class{static{this.prototype.isMatrix3=!0}constructor(e,t,i,s,r,a,o,c,l){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,a,o,c,l)}set(e,t,i,s,r,a,o,c,l){let u=this.elements;return u[0]=e,u[1]=s,u[2]=o,u[3]=t,u[4]=r,u[5]=c,u[6]=i,u[7]=a,u[8]=l,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],this}extractBasis(e,t,i){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,a=i[0],o=i[3],c=i[6],l=i[1],u=i[4],d=i[7],h=i[2],f=i[5],g=i[8],x=s[0],m=s[3],p=s[6],v=s[1],S=s[4],w=s[7],T=s[2],A=s[5],_=s[8];return r[0]=a*x+o*v+c*T,r[3]=a*m+o*S+c*A,r[6]=a*p+o*w+c*_,r[1]=l*x+u*v+d*T,r[4]=l*m+u*S+d*A,r[7]=l*p+u*w+d*_,r[2]=h*x+f*v+g*T,r[5]=h*m+f*S+g*A,r[8]=h*p+f*w+g*_,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],a=e[4],o=e[5],c=e[6],l=e[7],u=e[8];return t*a*u-t*o*l-i*r*u+i*o*c+s*r*l-s*a*c}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],a=e[4],o=e[5],c=e[6],l=e[7],u=e[8],d=u*a-o*l,h=o*c-u*r,f=l*r-a*c,g=t*d+i*h+s*f;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/g;return e[0]=d*x,e[1]=(s*l-u*i)*x,e[2]=(o*i-s*a)*x,e[3]=h*x,e[4]=(u*t-s*c)*x,e[5]=(s*r-o*t)*x,e[6]=f*x,e[7]=(i*c-l*t)*x,e[8]=(a*t-i*r)*x,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,i,s,r,a,o){let c=Math.cos(r),l=Math.sin(r);return this.set(i*c,i*l,-i*(c*a+l*o)+a+e,-s*l,s*c,-s*(-l*a+c*o)+o+t,0,0,1),this}scale(e,t){return Ys("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(fl.makeScale(e,t)),this}rotate(e){return Ys("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(fl.makeRotation(-e)),this}translate(e,t){return Ys("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(fl.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,i,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<9;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<9;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e}clone(){return new this.constructor().fromArray(this.elements)}},fl=new ke,Gh=new ke().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Vh=new ke().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Pp(){let n={enabled:!0,workingColorSpace:$s,spaces:{},convert:function(s,r,a){return this.enabled===!1||r===a||!r||!a||(this.spaces[r].transfer===it&&(s.r=Qn(s.r),s.g=Qn(s.g),s.b=Qn(s.b)),this.spaces[r].primaries!==this.spaces[a].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[a].fromXYZ)),this.spaces[a].transfer===it&&(s.r=gs(s.r),s.g=gs(s.g),s.b=gs(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===oi?Js:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,a){return s.copy(this.spaces[a].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[$s]:{primaries:e,whitePoint:i,transfer:Js,toXYZ:Gh,fromXYZ:Vh,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:Zt},outputColorSpaceConfig:{drawingBufferColorSpace:Zt}},[Zt]:{primaries:e,whitePoint:i,transfer:it,toXYZ:Gh,fromXYZ:Vh,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:Zt}}}),n}var Je=Pp();function Qn(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function gs(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var is,Ta=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let i;if(e instanceof HTMLCanvasElement)i=e;else{is===void 0&&(is=js("canvas")),is.width=e.width,is.height=e.height;let s=is.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),i=is}return i.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=js("canvas");t.width=e.width,t.height=e.height;let i=t.getContext("2d");i.drawImage(e,0,0,e.width,e.height);let s=i.getImageData(0,0,e.width,e.height),r=s.data;for(let a=0;a<r.length;a++)r[a]=Qn(r[a]/255)*255;return i.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let i=0;i<t.length;i++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[i]=Math.floor(Qn(t[i]/255)*255):t[i]=Qn(t[i]);return{data:t,width:e.width,height:e.height}}else return Le("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},Ip=0,vs=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Ip++}),this.uuid=Mr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let a=0,o=s.length;a<o;a++)s[a].isDataTexture?r.push(pl(s[a].image)):r.push(pl(s[a]))}else r=pl(s);i.url=r}return t||(e.images[this.uuid]=i),i}};function pl(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Ta.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Le("Texture: Unable to serialize Texture."),{})}var Dp=0,ml=new F,jt=class n extends kn{constructor(e=n.DEFAULT_IMAGE,t=n.DEFAULT_MAPPING,i=Fn,s=Fn,r=Jt,a=ri,o=Rn,c=rn,l=n.DEFAULT_ANISOTROPY,u=oi){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:Dp++}),this.uuid=Mr(),this.name="",this.source=new vs(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=a,this.anisotropy=l,this.format=o,this.internalFormat=null,this.type=c,this.offset=new je(0,0),this.repeat=new je(1,1),this.center=new je(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new ke,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(ml).x}get height(){return this.source.getSize(ml).y}get depth(){return this.source.getSize(ml).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let i=e[t];if(i===void 0){Le(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Le(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),t||(e.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Ql)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case wa:e.x=e.x-Math.floor(e.x);break;case Fn:e.x=e.x<0?0:1;break;case Sa:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case wa:e.y=e.y-Math.floor(e.y);break;case Fn:e.y=e.y<0?0:1;break;case Sa:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};jt.DEFAULT_IMAGE=null;jt.DEFAULT_MAPPING=Ql;jt.DEFAULT_ANISOTROPY=1;var xt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,i=0,s=1){this.x=e,this.y=t,this.z=i,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,i,s){return this.x=e,this.y=t,this.z=i,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=this.w,a=e.elements;return this.x=a[0]*t+a[4]*i+a[8]*s+a[12]*r,this.y=a[1]*t+a[5]*i+a[9]*s+a[13]*r,this.z=a[2]*t+a[6]*i+a[10]*s+a[14]*r,this.w=a[3]*t+a[7]*i+a[11]*s+a[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,i,s,r,c=e.elements,l=c[0],u=c[4],d=c[8],h=c[1],f=c[5],g=c[9],x=c[2],m=c[6],p=c[10];if(Math.abs(u-h)<.01&&Math.abs(d-x)<.01&&Math.abs(g-m)<.01){if(Math.abs(u+h)<.1&&Math.abs(d+x)<.1&&Math.abs(g+m)<.1&&Math.abs(l+f+p-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let S=(l+1)/2,w=(f+1)/2,T=(p+1)/2,A=(u+h)/4,_=(d+x)/4,M=(g+m)/4;return S>w&&S>T?S<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(S),s=A/i,r=_/i):w>T?w<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(w),i=A/s,r=M/s):T<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(T),i=_/r,s=M/r),this.set(i,s,r,t),this}let v=Math.sqrt((m-g)*(m-g)+(d-x)*(d-x)+(h-u)*(h-u));return Math.abs(v)<.001&&(v=1),this.x=(m-g)/v,this.y=(d-x)/v,this.z=(h-u)/v,this.w=Math.acos((l+f+p-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=Qe(this.x,e.x,t.x),this.y=Qe(this.y,e.y,t.y),this.z=Qe(this.z,e.z,t.z),this.w=Qe(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=Qe(this.x,e,t),this.y=Qe(this.y,e,t),this.z=Qe(this.z,e,t),this.w=Qe(this.w,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Qe(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this.w=e.w+(t.w-e.w)*i,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Ea=class extends kn{constructor(e=1,t=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Jt,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=i.depth,this.scissor=new xt(0,0,e,t),this.scissorTest=!1,this.viewport=new xt(0,0,e,t),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new jt({width:e,height:t,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:Jt,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,i=1){if(this.width!==e||this.height!==t||this.depth!==i){this.width=e,this.height=t,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,i=e.textures.length;t<i;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new vs(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},hn=class extends Ea{constructor(e=1,t=1,i={}){super(e,t,i),this.isWebGLRenderTarget=!0}},Qs=class extends jt{constructor(e=null,t=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=St,this.minFilter=St,this.wrapR=Fn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Ra=class extends jt{constructor(e=null,t=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=St,this.minFilter=St,this.wrapR=Fn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var ct=class n{static{this.prototype.isMatrix4=!0}constructor(e,t,i,s,r,a,o,c,l,u,d,h,f,g,x,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,a,o,c,l,u,d,h,f,g,x,m)}set(e,t,i,s,r,a,o,c,l,u,d,h,f,g,x,m){let p=this.elements;return p[0]=e,p[4]=t,p[8]=i,p[12]=s,p[1]=r,p[5]=a,p[9]=o,p[13]=c,p[2]=l,p[6]=u,p[10]=d,p[14]=h,p[3]=f,p[7]=g,p[11]=x,p[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],t[9]=i[9],t[10]=i[10],t[11]=i[11],t[12]=i[12],t[13]=i[13],t[14]=i[14],t[15]=i[15],this}copyPosition(e){let t=this.elements,i=e.elements;return t[12]=i[12],t[13]=i[13],t[14]=i[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,i){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),i.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(e,t,i){return this.set(e.x,t.x,i.x,0,e.y,t.y,i.y,0,e.z,t.z,i.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,i=e.elements,s=1/ss.setFromMatrixColumn(e,0).length(),r=1/ss.setFromMatrixColumn(e,1).length(),a=1/ss.setFromMatrixColumn(e,2).length();return t[0]=i[0]*s,t[1]=i[1]*s,t[2]=i[2]*s,t[3]=0,t[4]=i[4]*r,t[5]=i[5]*r,t[6]=i[6]*r,t[7]=0,t[8]=i[8]*a,t[9]=i[9]*a,t[10]=i[10]*a,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,i=e.x,s=e.y,r=e.z,a=Math.cos(i),o=Math.sin(i),c=Math.cos(s),l=Math.sin(s),u=Math.cos(r),d=Math.sin(r);if(e.order==="XYZ"){let h=a*u,f=a*d,g=o*u,x=o*d;t[0]=c*u,t[4]=-c*d,t[8]=l,t[1]=f+g*l,t[5]=h-x*l,t[9]=-o*c,t[2]=x-h*l,t[6]=g+f*l,t[10]=a*c}else if(e.order==="YXZ"){let h=c*u,f=c*d,g=l*u,x=l*d;t[0]=h+x*o,t[4]=g*o-f,t[8]=a*l,t[1]=a*d,t[5]=a*u,t[9]=-o,t[2]=f*o-g,t[6]=x+h*o,t[10]=a*c}else if(e.order==="ZXY"){let h=c*u,f=c*d,g=l*u,x=l*d;t[0]=h-x*o,t[4]=-a*d,t[8]=g+f*o,t[1]=f+g*o,t[5]=a*u,t[9]=x-h*o,t[2]=-a*l,t[6]=o,t[10]=a*c}else if(e.order==="ZYX"){let h=a*u,f=a*d,g=o*u,x=o*d;t[0]=c*u,t[4]=g*l-f,t[8]=h*l+x,t[1]=c*d,t[5]=x*l+h,t[9]=f*l-g,t[2]=-l,t[6]=o*c,t[10]=a*c}else if(e.order==="YZX"){let h=a*c,f=a*l,g=o*c,x=o*l;t[0]=c*u,t[4]=x-h*d,t[8]=g*d+f,t[1]=d,t[5]=a*u,t[9]=-o*u,t[2]=-l*u,t[6]=f*d+g,t[10]=h-x*d}else if(e.order==="XZY"){let h=a*c,f=a*l,g=o*c,x=o*l;t[0]=c*u,t[4]=-d,t[8]=l*u,t[1]=h*d+x,t[5]=a*u,t[9]=f*d-g,t[2]=g*d-f,t[6]=o*u,t[10]=x*d+h}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(Lp,e,Np)}lookAt(e,t,i){let s=this.elements;return ln.subVectors(e,t),ln.lengthSq()===0&&(ln.z=1),ln.normalize(),di.crossVectors(i,ln),di.lengthSq()===0&&(Math.abs(i.z)===1?ln.x+=1e-4:ln.z+=1e-4,ln.normalize(),di.crossVectors(i,ln)),di.normalize(),Xr.crossVectors(ln,di),s[0]=di.x,s[4]=Xr.x,s[8]=ln.x,s[1]=di.y,s[5]=Xr.y,s[9]=ln.y,s[2]=di.z,s[6]=Xr.z,s[10]=ln.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,a=i[0],o=i[4],c=i[8],l=i[12],u=i[1],d=i[5],h=i[9],f=i[13],g=i[2],x=i[6],m=i[10],p=i[14],v=i[3],S=i[7],w=i[11],T=i[15],A=s[0],_=s[4],M=s[8],U=s[12],D=s[1],N=s[5],B=s[9],W=s[13],P=s[2],H=s[6],K=s[10],V=s[14],ie=s[3],q=s[7],Q=s[11],ee=s[15];return r[0]=a*A+o*D+c*P+l*ie,r[4]=a*_+o*N+c*H+l*q,r[8]=a*M+o*B+c*K+l*Q,r[12]=a*U+o*W+c*V+l*ee,r[1]=u*A+d*D+h*P+f*ie,r[5]=u*_+d*N+h*H+f*q,r[9]=u*M+d*B+h*K+f*Q,r[13]=u*U+d*W+h*V+f*ee,r[2]=g*A+x*D+m*P+p*ie,r[6]=g*_+x*N+m*H+p*q,r[10]=g*M+x*B+m*K+p*Q,r[14]=g*U+x*W+m*V+p*ee,r[3]=v*A+S*D+w*P+T*ie,r[7]=v*_+S*N+w*H+T*q,r[11]=v*M+S*B+w*K+T*Q,r[15]=v*U+S*W+w*V+T*ee,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[12],a=e[1],o=e[5],c=e[9],l=e[13],u=e[2],d=e[6],h=e[10],f=e[14],g=e[3],x=e[7],m=e[11],p=e[15],v=c*f-l*h,S=o*f-l*d,w=o*h-c*d,T=a*f-l*u,A=a*h-c*u,_=a*d-o*u;return t*(x*v-m*S+p*w)-i*(g*v-m*T+p*A)+s*(g*S-x*T+p*_)-r*(g*w-x*A+m*_)}determinantAffine(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[1],a=e[5],o=e[9],c=e[2],l=e[6],u=e[10];return t*(a*u-o*l)-i*(r*u-o*c)+s*(r*l-a*c)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,i){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=i),this}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],a=e[4],o=e[5],c=e[6],l=e[7],u=e[8],d=e[9],h=e[10],f=e[11],g=e[12],x=e[13],m=e[14],p=e[15],v=t*o-i*a,S=t*c-s*a,w=t*l-r*a,T=i*c-s*o,A=i*l-r*o,_=s*l-r*c,M=u*x-d*g,U=u*m-h*g,D=u*p-f*g,N=d*m-h*x,B=d*p-f*x,W=h*p-f*m,P=v*W-S*B+w*N+T*D-A*U+_*M;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let H=1/P;return e[0]=(o*W-c*B+l*N)*H,e[1]=(s*B-i*W-r*N)*H,e[2]=(x*_-m*A+p*T)*H,e[3]=(h*A-d*_-f*T)*H,e[4]=(c*D-a*W-l*U)*H,e[5]=(t*W-s*D+r*U)*H,e[6]=(m*w-g*_-p*S)*H,e[7]=(u*_-h*w+f*S)*H,e[8]=(a*B-o*D+l*M)*H,e[9]=(i*D-t*B-r*M)*H,e[10]=(g*A-x*w+p*v)*H,e[11]=(d*w-u*A-f*v)*H,e[12]=(o*U-a*N-c*M)*H,e[13]=(t*N-i*U+s*M)*H,e[14]=(x*S-g*T-m*v)*H,e[15]=(u*T-d*S+h*v)*H,this}scale(e){let t=this.elements,i=e.x,s=e.y,r=e.z;return t[0]*=i,t[4]*=s,t[8]*=r,t[1]*=i,t[5]*=s,t[9]*=r,t[2]*=i,t[6]*=s,t[10]*=r,t[3]*=i,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],i=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,i,s))}makeTranslation(e,t,i){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,i,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),i=Math.sin(e);return this.set(1,0,0,0,0,t,-i,0,0,i,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,0,i,0,0,1,0,0,-i,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,0,i,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let i=Math.cos(t),s=Math.sin(t),r=1-i,a=e.x,o=e.y,c=e.z,l=r*a,u=r*o;return this.set(l*a+i,l*o-s*c,l*c+s*o,0,l*o+s*c,u*o+i,u*c-s*a,0,l*c-s*o,u*c+s*a,r*c*c+i,0,0,0,0,1),this}makeScale(e,t,i){return this.set(e,0,0,0,0,t,0,0,0,0,i,0,0,0,0,1),this}makeShear(e,t,i,s,r,a){return this.set(1,i,r,0,e,1,a,0,t,s,1,0,0,0,0,1),this}compose(e,t,i){let s=this.elements,r=t._x,a=t._y,o=t._z,c=t._w,l=r+r,u=a+a,d=o+o,h=r*l,f=r*u,g=r*d,x=a*u,m=a*d,p=o*d,v=c*l,S=c*u,w=c*d,T=i.x,A=i.y,_=i.z;return s[0]=(1-(x+p))*T,s[1]=(f+w)*T,s[2]=(g-S)*T,s[3]=0,s[4]=(f-w)*A,s[5]=(1-(h+p))*A,s[6]=(m+v)*A,s[7]=0,s[8]=(g+S)*_,s[9]=(m-v)*_,s[10]=(1-(h+x))*_,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,i){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),t.identity(),this;let a=ss.set(s[0],s[1],s[2]).length(),o=ss.set(s[4],s[5],s[6]).length(),c=ss.set(s[8],s[9],s[10]).length();r<0&&(a=-a),yn.copy(this);let l=1/a,u=1/o,d=1/c;return yn.elements[0]*=l,yn.elements[1]*=l,yn.elements[2]*=l,yn.elements[4]*=u,yn.elements[5]*=u,yn.elements[6]*=u,yn.elements[8]*=d,yn.elements[9]*=d,yn.elements[10]*=d,t.setFromRotationMatrix(yn),i.x=a,i.y=o,i.z=c,this}makePerspective(e,t,i,s,r,a,o=_n,c=!1){let l=this.elements,u=2*r/(t-e),d=2*r/(i-s),h=(t+e)/(t-e),f=(i+s)/(i-s),g,x;if(c)g=r/(a-r),x=a*r/(a-r);else if(o===_n)g=-(a+r)/(a-r),x=-2*a*r/(a-r);else if(o===bs)g=-a/(a-r),x=-a*r/(a-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+o);return l[0]=u,l[4]=0,l[8]=h,l[12]=0,l[1]=0,l[5]=d,l[9]=f,l[13]=0,l[2]=0,l[6]=0,l[10]=g,l[14]=x,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(e,t,i,s,r,a,o=_n,c=!1){let l=this.elements,u=2/(t-e),d=2/(i-s),h=-(t+e)/(t-e),f=-(i+s)/(i-s),g,x;if(c)g=1/(a-r),x=a/(a-r);else if(o===_n)g=-2/(a-r),x=-(a+r)/(a-r);else if(o===bs)g=-1/(a-r),x=-r/(a-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+o);return l[0]=u,l[4]=0,l[8]=0,l[12]=h,l[1]=0,l[5]=d,l[9]=0,l[13]=f,l[2]=0,l[6]=0,l[10]=g,l[14]=x,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<16;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<16;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e[t+9]=i[9],e[t+10]=i[10],e[t+11]=i[11],e[t+12]=i[12],e[t+13]=i[13],e[t+14]=i[14],e[t+15]=i[15],e}},ss=new F,yn=new ct,Lp=new F(0,0,0),Np=new F(1,1,1),di=new F,Xr=new F,ln=new F,Hh=new ct,Wh=new bn,ti=class n{constructor(e=0,t=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=i,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,i,s=this._order){return this._x=e,this._y=t,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,i=!0){let s=e.elements,r=s[0],a=s[4],o=s[8],c=s[1],l=s[5],u=s[9],d=s[2],h=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(Qe(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(-u,f),this._z=Math.atan2(-a,r)):(this._x=Math.atan2(h,l),this._z=0);break;case"YXZ":this._x=Math.asin(-Qe(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(o,f),this._z=Math.atan2(c,l)):(this._y=Math.atan2(-d,r),this._z=0);break;case"ZXY":this._x=Math.asin(Qe(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(-d,f),this._z=Math.atan2(-a,l)):(this._y=0,this._z=Math.atan2(c,r));break;case"ZYX":this._y=Math.asin(-Qe(d,-1,1)),Math.abs(d)<.9999999?(this._x=Math.atan2(h,f),this._z=Math.atan2(c,r)):(this._x=0,this._z=Math.atan2(-a,l));break;case"YZX":this._z=Math.asin(Qe(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(-u,l),this._y=Math.atan2(-d,r)):(this._x=0,this._y=Math.atan2(o,f));break;case"XZY":this._z=Math.asin(-Qe(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(h,l),this._y=Math.atan2(o,r)):(this._x=Math.atan2(-u,f),this._y=0);break;default:Le("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,i===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,i){return Hh.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Hh,t,i)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Wh.setFromEuler(this),this.setFromQuaternion(Wh,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};ti.DEFAULT_ORDER="XYZ";var er=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},Fp=0,Xh=new F,rs=new bn,Yn=new ct,qr=new F,Hs=new F,Up=new F,kp=new bn,qh=new F(1,0,0),Kh=new F(0,1,0),Yh=new F(0,0,1),Zh={type:"added"},Op={type:"removed"},as={type:"childadded",child:null},gl={type:"childremoved",child:null},Gt=class n extends kn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Fp++}),this.uuid=Mr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let e=new F,t=new ti,i=new bn,s=new F(1,1,1);function r(){i.setFromEuler(t,!1)}function a(){t.setFromQuaternion(i,void 0,!1)}t._onChange(r),i._onChange(a),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new ct},normalMatrix:{value:new ke}}),this.matrix=new ct,this.matrixWorld=new ct,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new er,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return rs.setFromAxisAngle(e,t),this.quaternion.multiply(rs),this}rotateOnWorldAxis(e,t){return rs.setFromAxisAngle(e,t),this.quaternion.premultiply(rs),this}rotateX(e){return this.rotateOnAxis(qh,e)}rotateY(e){return this.rotateOnAxis(Kh,e)}rotateZ(e){return this.rotateOnAxis(Yh,e)}translateOnAxis(e,t){return Xh.copy(e).applyQuaternion(this.quaternion),this.position.add(Xh.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(qh,e)}translateY(e){return this.translateOnAxis(Kh,e)}translateZ(e){return this.translateOnAxis(Yh,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Yn.copy(this.matrixWorld).invert())}lookAt(e,t,i){e.isVector3?qr.copy(e):qr.set(e,t,i);let s=this.parent;this.updateWorldMatrix(!0,!1),Hs.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Yn.lookAt(Hs,qr,this.up):Yn.lookAt(qr,Hs,this.up),this.quaternion.setFromRotationMatrix(Yn),s&&(Yn.extractRotation(s.matrixWorld),rs.setFromRotationMatrix(Yn),this.quaternion.premultiply(rs.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(Ue("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(Zh),as.child=e,this.dispatchEvent(as),as.child=null):Ue("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(Op),gl.child=e,this.dispatchEvent(gl),gl.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Yn.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Yn.multiply(e.parent.matrixWorld)),e.applyMatrix4(Yn),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(Zh),as.child=e,this.dispatchEvent(as),as.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let i=0,s=this.children.length;i<s;i++){let a=this.children[i].getObjectByProperty(e,t);if(a!==void 0)return a}}getObjectsByProperty(e,t,i=[]){this[e]===t&&i.push(this);let s=this.children;for(let r=0,a=s.length;r<a;r++)s[r].getObjectsByProperty(e,t,i);return i}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Hs,e,Up),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Hs,kp,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,i=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*i-r[8]*s,r[13]+=i-r[1]*t-r[5]*i-r[9]*s,r[14]+=s-r[2]*t-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].updateMatrixWorld(e)}updateWorldMatrix(e,t,i=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),t===!0){let r=this.children;for(let a=0,o=r.length;a<o;a++)r[a].updateWorldMatrix(!1,!0,i)}}toJSON(e){let t=e===void 0||typeof e=="string",i={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(o=>({...o,boundingBox:o.boundingBox?o.boundingBox.toJSON():void 0,boundingSphere:o.boundingSphere?o.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(o=>({...o})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(o,c){return o[c.uuid]===void 0&&(o[c.uuid]=c.toJSON(e)),c.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let o=this.geometry.parameters;if(o!==void 0&&o.shapes!==void 0){let c=o.shapes;if(Array.isArray(c))for(let l=0,u=c.length;l<u;l++){let d=c[l];r(e.shapes,d)}else r(e.shapes,c)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let o=[];for(let c=0,l=this.material.length;c<l;c++)o.push(r(e.materials,this.material[c]));s.material=o}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let o=0;o<this.children.length;o++)s.children.push(this.children[o].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let o=0;o<this.animations.length;o++){let c=this.animations[o];s.animations.push(r(e.animations,c))}}if(t){let o=a(e.geometries),c=a(e.materials),l=a(e.textures),u=a(e.images),d=a(e.shapes),h=a(e.skeletons),f=a(e.animations),g=a(e.nodes);o.length>0&&(i.geometries=o),c.length>0&&(i.materials=c),l.length>0&&(i.textures=l),u.length>0&&(i.images=u),d.length>0&&(i.shapes=d),h.length>0&&(i.skeletons=h),f.length>0&&(i.animations=f),g.length>0&&(i.nodes=g)}return i.object=s,i;function a(o){let c=[];for(let l in o){let u=o[l];delete u.metadata,c.push(u)}return c}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let i=0;i<e.children.length;i++){let s=e.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Gt.DEFAULT_UP=new F(0,1,0);Gt.DEFAULT_MATRIX_AUTO_UPDATE=!0;Gt.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var tn=class extends Gt{constructor(){super(),this.isGroup=!0,this.type="Group"}},Bp={type:"move"},ys=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new tn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new tn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new F,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new F),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new tn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new F,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new F,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let i of e.hand.values())this._getHandJoint(t,i)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,i){let s=null,r=null,a=null,o=this._targetRay,c=this._grip,l=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(l&&e.hand){a=!0;for(let x of e.hand.values()){let m=t.getJointPose(x,i),p=this._getHandJoint(l,x);m!==null&&(p.matrix.fromArray(m.transform.matrix),p.matrix.decompose(p.position,p.quaternion,p.scale),p.matrixWorldNeedsUpdate=!0,p.jointRadius=m.radius),p.visible=m!==null}let u=l.joints["index-finger-tip"],d=l.joints["thumb-tip"],h=u.position.distanceTo(d.position),f=.02,g=.005;l.inputState.pinching&&h>f+g?(l.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!l.inputState.pinching&&h<=f-g&&(l.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else c!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,i),r!==null&&(c.matrix.fromArray(r.transform.matrix),c.matrix.decompose(c.position,c.quaternion,c.scale),c.matrixWorldNeedsUpdate=!0,r.linearVelocity?(c.hasLinearVelocity=!0,c.linearVelocity.copy(r.linearVelocity)):c.hasLinearVelocity=!1,r.angularVelocity?(c.hasAngularVelocity=!0,c.angularVelocity.copy(r.angularVelocity)):c.hasAngularVelocity=!1,c.eventsEnabled&&c.dispatchEvent({type:"gripUpdated",data:e,target:this})));o!==null&&(s=t.getPose(e.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(o.matrix.fromArray(s.transform.matrix),o.matrix.decompose(o.position,o.quaternion,o.scale),o.matrixWorldNeedsUpdate=!0,s.linearVelocity?(o.hasLinearVelocity=!0,o.linearVelocity.copy(s.linearVelocity)):o.hasLinearVelocity=!1,s.angularVelocity?(o.hasAngularVelocity=!0,o.angularVelocity.copy(s.angularVelocity)):o.hasAngularVelocity=!1,this.dispatchEvent(Bp)))}return o!==null&&(o.visible=s!==null),c!==null&&(c.visible=r!==null),l!==null&&(l.visible=a!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let i=new tn;i.matrixAutoUpdate=!1,i.visible=!1,e.joints[t.jointName]=i,e.add(i)}return e.joints[t.jointName]}},$u={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},fi={h:0,s:0,l:0},Kr={h:0,s:0,l:0};function _l(n,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?n+(e-n)*6*t:t<1/2?e:t<2/3?n+(e-n)*6*(2/3-t):n}var Xe=class{constructor(e,t,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,i)}set(e,t,i){if(t===void 0&&i===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,i);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=Zt){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,Je.colorSpaceToWorking(this,t),this}setRGB(e,t,i,s=Je.workingColorSpace){return this.r=e,this.g=t,this.b=i,Je.colorSpaceToWorking(this,s),this}setHSL(e,t,i,s=Je.workingColorSpace){if(e=Ep(e,1),t=Qe(t,0,1),i=Qe(i,0,1),t===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+t):i+t-i*t,a=2*i-r;this.r=_l(a,r,e+1/3),this.g=_l(a,r,e),this.b=_l(a,r,e-1/3)}return Je.colorSpaceToWorking(this,s),this}setStyle(e,t=Zt){function i(r){r!==void 0&&parseFloat(r)<1&&Le("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,a=s[1],o=s[2];switch(a){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(o))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Le("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],a=r.length;if(a===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(a===6)return this.setHex(parseInt(r,16),t);Le("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=Zt){let i=$u[e.toLowerCase()];return i!==void 0?this.setHex(i,t):Le("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Qn(e.r),this.g=Qn(e.g),this.b=Qn(e.b),this}copyLinearToSRGB(e){return this.r=gs(e.r),this.g=gs(e.g),this.b=gs(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=Zt){return Je.workingToColorSpace(Xt.copy(this),e),Math.round(Qe(Xt.r*255,0,255))*65536+Math.round(Qe(Xt.g*255,0,255))*256+Math.round(Qe(Xt.b*255,0,255))}getHexString(e=Zt){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=Je.workingColorSpace){Je.workingToColorSpace(Xt.copy(this),t);let i=Xt.r,s=Xt.g,r=Xt.b,a=Math.max(i,s,r),o=Math.min(i,s,r),c,l,u=(o+a)/2;if(o===a)c=0,l=0;else{let d=a-o;switch(l=u<=.5?d/(a+o):d/(2-a-o),a){case i:c=(s-r)/d+(s<r?6:0);break;case s:c=(r-i)/d+2;break;case r:c=(i-s)/d+4;break}c/=6}return e.h=c,e.s=l,e.l=u,e}getRGB(e,t=Je.workingColorSpace){return Je.workingToColorSpace(Xt.copy(this),t),e.r=Xt.r,e.g=Xt.g,e.b=Xt.b,e}getStyle(e=Zt){Je.workingToColorSpace(Xt.copy(this),e);let t=Xt.r,i=Xt.g,s=Xt.b;return e!==Zt?`color(${e} ${t.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(e,t,i){return this.getHSL(fi),this.setHSL(fi.h+e,fi.s+t,fi.l+i)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,i){return this.r=e.r+(t.r-e.r)*i,this.g=e.g+(t.g-e.g)*i,this.b=e.b+(t.b-e.b)*i,this}lerpHSL(e,t){this.getHSL(fi),e.getHSL(Kr);let i=ul(fi.h,Kr.h,t),s=ul(fi.s,Kr.s,t),r=ul(fi.l,Kr.l,t);return this.setHSL(i,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,i=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*i+r[6]*s,this.g=r[1]*t+r[4]*i+r[7]*s,this.b=r[2]*t+r[5]*i+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Xt=new Xe;Xe.NAMES=$u;var tr=class extends Gt{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new ti,this.environmentIntensity=1,this.environmentRotation=new ti,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},wn=new F,Zn=new F,bl=new F,$n=new F,os=new F,ls=new F,$h=new F,xl=new F,vl=new F,yl=new F,wl=new xt,Sl=new xt,Ml=new xt,_i=class n{constructor(e=new F,t=new F,i=new F){this.a=e,this.b=t,this.c=i}static getNormal(e,t,i,s){s.subVectors(i,t),wn.subVectors(e,t),s.cross(wn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,i,s,r){wn.subVectors(s,t),Zn.subVectors(i,t),bl.subVectors(e,t);let a=wn.dot(wn),o=wn.dot(Zn),c=wn.dot(bl),l=Zn.dot(Zn),u=Zn.dot(bl),d=a*l-o*o;if(d===0)return r.set(0,0,0),null;let h=1/d,f=(l*c-o*u)*h,g=(a*u-o*c)*h;return r.set(1-f-g,g,f)}static containsPoint(e,t,i,s){return this.getBarycoord(e,t,i,s,$n)===null?!1:$n.x>=0&&$n.y>=0&&$n.x+$n.y<=1}static getInterpolation(e,t,i,s,r,a,o,c){return this.getBarycoord(e,t,i,s,$n)===null?(c.x=0,c.y=0,"z"in c&&(c.z=0),"w"in c&&(c.w=0),null):(c.setScalar(0),c.addScaledVector(r,$n.x),c.addScaledVector(a,$n.y),c.addScaledVector(o,$n.z),c)}static getInterpolatedAttribute(e,t,i,s,r,a){return wl.setScalar(0),Sl.setScalar(0),Ml.setScalar(0),wl.fromBufferAttribute(e,t),Sl.fromBufferAttribute(e,i),Ml.fromBufferAttribute(e,s),a.setScalar(0),a.addScaledVector(wl,r.x),a.addScaledVector(Sl,r.y),a.addScaledVector(Ml,r.z),a}static isFrontFacing(e,t,i,s){return wn.subVectors(i,t),Zn.subVectors(e,t),wn.cross(Zn).dot(s)<0}set(e,t,i){return this.a.copy(e),this.b.copy(t),this.c.copy(i),this}setFromPointsAndIndices(e,t,i,s){return this.a.copy(e[t]),this.b.copy(e[i]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,i,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,i),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return wn.subVectors(this.c,this.b),Zn.subVectors(this.a,this.b),wn.cross(Zn).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return n.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return n.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,i,s,r){return n.getInterpolation(e,this.a,this.b,this.c,t,i,s,r)}containsPoint(e){return n.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return n.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let i=this.a,s=this.b,r=this.c,a,o;os.subVectors(s,i),ls.subVectors(r,i),xl.subVectors(e,i);let c=os.dot(xl),l=ls.dot(xl);if(c<=0&&l<=0)return t.copy(i);vl.subVectors(e,s);let u=os.dot(vl),d=ls.dot(vl);if(u>=0&&d<=u)return t.copy(s);let h=c*d-u*l;if(h<=0&&c>=0&&u<=0&&c-u>0)return a=c/(c-u),t.copy(i).addScaledVector(os,a);yl.subVectors(e,r);let f=os.dot(yl),g=ls.dot(yl);if(g>=0&&f<=g)return t.copy(r);let x=f*l-c*g;if(x<=0&&l>=0&&g<=0)return o=l/(l-g),t.copy(i).addScaledVector(ls,o);let m=u*g-f*d;if(m<=0&&d-u>=0&&f-g>=0)return $h.subVectors(r,s),o=(d-u)/(d-u+(f-g)),t.copy(s).addScaledVector($h,o);let p=1/(m+x+h);return a=x*p,o=h*p,t.copy(i).addScaledVector(os,a).addScaledVector(ls,o)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},bi=class{constructor(e=new F(1/0,1/0,1/0),t=new F(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t+=3)this.expandByPoint(Sn.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,i=e.count;t<i;t++)this.expandByPoint(Sn.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let i=Sn.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(i),this.max.copy(e).add(i),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let i=e.geometry;if(i!==void 0){let r=i.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let a=0,o=r.count;a<o;a++)e.isMesh===!0?e.getVertexPosition(a,Sn):Sn.fromBufferAttribute(r,a),Sn.applyMatrix4(e.matrixWorld),this.expandByPoint(Sn);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),Yr.copy(e.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),Yr.copy(i.boundingBox)),Yr.applyMatrix4(e.matrixWorld),this.union(Yr)}let s=e.children;for(let r=0,a=s.length;r<a;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Sn),Sn.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,i;return e.normal.x>0?(t=e.normal.x*this.min.x,i=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,i=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,i+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,i+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,i+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,i+=e.normal.z*this.min.z),t<=-e.constant&&i>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Ws),Zr.subVectors(this.max,Ws),cs.subVectors(e.a,Ws),hs.subVectors(e.b,Ws),us.subVectors(e.c,Ws),pi.subVectors(hs,cs),mi.subVectors(us,hs),zi.subVectors(cs,us);let t=[0,-pi.z,pi.y,0,-mi.z,mi.y,0,-zi.z,zi.y,pi.z,0,-pi.x,mi.z,0,-mi.x,zi.z,0,-zi.x,-pi.y,pi.x,0,-mi.y,mi.x,0,-zi.y,zi.x,0];return!Al(t,cs,hs,us,Zr)||(t=[1,0,0,0,1,0,0,0,1],!Al(t,cs,hs,us,Zr))?!1:($r.crossVectors(pi,mi),t=[$r.x,$r.y,$r.z],Al(t,cs,hs,us,Zr))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Sn).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Sn).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Jn[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Jn[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Jn[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Jn[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Jn[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Jn[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Jn[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Jn[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Jn),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Jn=[new F,new F,new F,new F,new F,new F,new F,new F],Sn=new F,Yr=new bi,cs=new F,hs=new F,us=new F,pi=new F,mi=new F,zi=new F,Ws=new F,Zr=new F,$r=new F,Gi=new F;function Al(n,e,t,i,s){for(let r=0,a=n.length-3;r<=a;r+=3){Gi.fromArray(n,r);let o=s.x*Math.abs(Gi.x)+s.y*Math.abs(Gi.y)+s.z*Math.abs(Gi.z),c=e.dot(Gi),l=t.dot(Gi),u=i.dot(Gi);if(Math.max(-Math.max(c,l,u),Math.min(c,l,u))>o)return!1}return!0}var Tt=new F,Jr=new je,zp=0,Un=class extends kn{constructor(e,t,i=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:zp++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=i,this.usage=Wu,this.updateRanges=[],this.gpuType=Tn,this.version=0,this._normalizationScale=e!==void 0?dc(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,i){e*=this.itemSize,i*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[i+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,i=this.count;t<i;t++)Jr.fromBufferAttribute(this,t),Jr.applyMatrix3(e),this.setXY(t,Jr.x,Jr.y);else if(this.itemSize===3)for(let t=0,i=this.count;t<i;t++)Tt.fromBufferAttribute(this,t),Tt.applyMatrix3(e),this.setXYZ(t,Tt.x,Tt.y,Tt.z);return this}applyMatrix4(e){for(let t=0,i=this.count;t<i;t++)Tt.fromBufferAttribute(this,t),Tt.applyMatrix4(e),this.setXYZ(t,Tt.x,Tt.y,Tt.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)Tt.fromBufferAttribute(this,t),Tt.applyNormalMatrix(e),this.setXYZ(t,Tt.x,Tt.y,Tt.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)Tt.fromBufferAttribute(this,t),Tt.transformDirection(e),this.setXYZ(t,Tt.x,Tt.y,Tt.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let i=this.array[e*this.itemSize+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.array[e*this.itemSize+t]=i,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=i,this}setXYZ(e,t,i,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Rp(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Cp(e,this.array)}};var nr=class extends Un{constructor(e,t,i){super(new Uint16Array(e),t,i)}};var ir=class extends Un{constructor(e,t,i){super(new Uint32Array(e),t,i)}};var wt=class extends Un{constructor(e,t,i){super(new Float32Array(e),t,i)}},Gp=new bi,Xs=new F,Tl=new F,Wi=class{constructor(e=new F,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let i=this.center;t!==void 0?i.copy(t):Gp.setFromPoints(e).getCenter(i);let s=0;for(let r=0,a=e.length;r<a;r++)s=Math.max(s,i.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let i=this.center.distanceToSquared(e);return t.copy(e),i>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Xs.subVectors(e,this.center);let t=Xs.lengthSq();if(t>this.radius*this.radius){let i=Math.sqrt(t),s=(i-this.radius)*.5;this.center.addScaledVector(Xs,s/i),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(Tl.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Xs.copy(e.center).add(Tl)),this.expandByPoint(Xs.copy(e.center).sub(Tl))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},Vp=0,gn=new ct,El=new Gt,ds=new F,cn=new bi,qs=new bi,kt=new F,nn=class n extends kn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Vp++}),this.uuid=Mr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(Ap(e)?ir:nr)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,i=0){this.groups.push({start:e,count:t,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new ke().getNormalMatrix(e);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return gn.makeRotationFromQuaternion(e),this.applyMatrix4(gn),this}rotateX(e){return gn.makeRotationX(e),this.applyMatrix4(gn),this}rotateY(e){return gn.makeRotationY(e),this.applyMatrix4(gn),this}rotateZ(e){return gn.makeRotationZ(e),this.applyMatrix4(gn),this}translate(e,t,i){return gn.makeTranslation(e,t,i),this.applyMatrix4(gn),this}scale(e,t,i){return gn.makeScale(e,t,i),this.applyMatrix4(gn),this}lookAt(e){return El.lookAt(e),El.updateMatrix(),this.applyMatrix4(El.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(ds).negate(),this.translate(ds.x,ds.y,ds.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let i=[];for(let s=0,r=e.length;s<r;s++){let a=e[s];i.push(a.x,a.y,a.z||0)}this.setAttribute("position",new wt(i,3))}else{let i=Math.min(e.length,t.count);for(let s=0;s<i;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Le("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new bi);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Ue("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new F(-1/0,-1/0,-1/0),new F(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let i=0,s=t.length;i<s;i++){let r=t[i];cn.setFromBufferAttribute(r),this.morphTargetsRelative?(kt.addVectors(this.boundingBox.min,cn.min),this.boundingBox.expandByPoint(kt),kt.addVectors(this.boundingBox.max,cn.max),this.boundingBox.expandByPoint(kt)):(this.boundingBox.expandByPoint(cn.min),this.boundingBox.expandByPoint(cn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Ue('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Wi);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Ue("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new F,1/0);return}if(e){let i=this.boundingSphere.center;if(cn.setFromBufferAttribute(e),t)for(let r=0,a=t.length;r<a;r++){let o=t[r];qs.setFromBufferAttribute(o),this.morphTargetsRelative?(kt.addVectors(cn.min,qs.min),cn.expandByPoint(kt),kt.addVectors(cn.max,qs.max),cn.expandByPoint(kt)):(cn.expandByPoint(qs.min),cn.expandByPoint(qs.max))}cn.getCenter(i);let s=0;for(let r=0,a=e.count;r<a;r++)kt.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(kt));if(t)for(let r=0,a=t.length;r<a;r++){let o=t[r],c=this.morphTargetsRelative;for(let l=0,u=o.count;l<u;l++)kt.fromBufferAttribute(o,l),c&&(ds.fromBufferAttribute(e,l),kt.add(ds)),s=Math.max(s,i.distanceToSquared(kt))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Ue('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){Ue("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=t.position,s=t.normal,r=t.uv,a=this.getAttribute("tangent");(a===void 0||a.count!==i.count)&&(a=new Un(new Float32Array(4*i.count),4),this.setAttribute("tangent",a));let o=[],c=[],l=new Uint8Array(i.count);for(let U=0;U<i.count;U++)o[U]=new F,c[U]=new F;let u=new F,d=new F,h=new F,f=new je,g=new je,x=new je,m=new F,p=new F;function v(U,D,N){l[U]=l[D]=l[N]=1,u.fromBufferAttribute(i,U),d.fromBufferAttribute(i,D),h.fromBufferAttribute(i,N),f.fromBufferAttribute(r,U),g.fromBufferAttribute(r,D),x.fromBufferAttribute(r,N),d.sub(u),h.sub(u),g.sub(f),x.sub(f);let B=1/(g.x*x.y-x.x*g.y);isFinite(B)&&(m.copy(d).multiplyScalar(x.y).addScaledVector(h,-g.y).multiplyScalar(B),p.copy(h).multiplyScalar(g.x).addScaledVector(d,-x.x).multiplyScalar(B),o[U].add(m),o[D].add(m),o[N].add(m),c[U].add(p),c[D].add(p),c[N].add(p))}let S=this.groups;S.length===0&&(S=[{start:0,count:e.count}]);for(let U=0,D=S.length;U<D;++U){let N=S[U],B=N.start,W=N.count;for(let P=B,H=B+W;P<H;P+=3)v(e.getX(P+0),e.getX(P+1),e.getX(P+2))}let w=new F,T=new F,A=new F,_=new F;function M(U){A.fromBufferAttribute(s,U),_.copy(A);let D=o[U];w.copy(D),w.sub(A.multiplyScalar(A.dot(D))).normalize(),T.crossVectors(_,D);let B=T.dot(c[U])<0?-1:1;a.setXYZW(U,w.x,w.y,w.z,B)}for(let U=0,D=i.count;U<D;++U)l[U]&&M(U);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==t.count)i=new Un(new Float32Array(t.count*3),3),this.setAttribute("normal",i);else for(let h=0,f=i.count;h<f;h++)i.setXYZ(h,0,0,0);let s=new F,r=new F,a=new F,o=new F,c=new F,l=new F,u=new F,d=new F;if(e)for(let h=0,f=e.count;h<f;h+=3){let g=e.getX(h+0),x=e.getX(h+1),m=e.getX(h+2);s.fromBufferAttribute(t,g),r.fromBufferAttribute(t,x),a.fromBufferAttribute(t,m),u.subVectors(a,r),d.subVectors(s,r),u.cross(d),o.fromBufferAttribute(i,g),c.fromBufferAttribute(i,x),l.fromBufferAttribute(i,m),o.add(u),c.add(u),l.add(u),i.setXYZ(g,o.x,o.y,o.z),i.setXYZ(x,c.x,c.y,c.z),i.setXYZ(m,l.x,l.y,l.z)}else for(let h=0,f=t.count;h<f;h+=3)s.fromBufferAttribute(t,h+0),r.fromBufferAttribute(t,h+1),a.fromBufferAttribute(t,h+2),u.subVectors(a,r),d.subVectors(s,r),u.cross(d),i.setXYZ(h+0,u.x,u.y,u.z),i.setXYZ(h+1,u.x,u.y,u.z),i.setXYZ(h+2,u.x,u.y,u.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,i=e.count;t<i;t++)kt.fromBufferAttribute(e,t),kt.normalize(),e.setXYZ(t,kt.x,kt.y,kt.z)}toNonIndexed(){function e(o,c){let l=o.array,u=o.itemSize,d=o.normalized,h=new l.constructor(c.length*u),f=0,g=0;for(let x=0,m=c.length;x<m;x++){o.isInterleavedBufferAttribute?f=c[x]*o.data.stride+o.offset:f=c[x]*u;for(let p=0;p<u;p++)h[g++]=l[f++]}return new Un(h,u,d)}if(this.index===null)return Le("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new n,i=this.index.array,s=this.attributes;for(let o in s){let c=s[o],l=e(c,i);t.setAttribute(o,l)}let r=this.morphAttributes;for(let o in r){let c=[],l=r[o];for(let u=0,d=l.length;u<d;u++){let h=l[u],f=e(h,i);c.push(f)}t.morphAttributes[o]=c}t.morphTargetsRelative=this.morphTargetsRelative;let a=this.groups;for(let o=0,c=a.length;o<c;o++){let l=a[o];t.addGroup(l.start,l.count,l.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let c=this.parameters;for(let l in c)c[l]!==void 0&&(e[l]=c[l]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let i=this.attributes;for(let c in i){let l=i[c];e.data.attributes[c]=l.toJSON(e.data)}let s={},r=!1;for(let c in this.morphAttributes){let l=this.morphAttributes[c],u=[];for(let d=0,h=l.length;d<h;d++){let f=l[d];u.push(f.toJSON(e.data))}u.length>0&&(s[c]=u,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let a=this.groups;a.length>0&&(e.data.groups=JSON.parse(JSON.stringify(a)));let o=this.boundingSphere;return o!==null&&(e.data.boundingSphere=o.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let i=e.index;i!==null&&this.setIndex(i.clone());let s=e.attributes;for(let l in s){let u=s[l];this.setAttribute(l,u.clone(t))}let r=e.morphAttributes;for(let l in r){let u=[],d=r[l];for(let h=0,f=d.length;h<f;h++)u.push(d[h].clone(t));this.morphAttributes[l]=u}this.morphTargetsRelative=e.morphTargetsRelative;let a=e.groups;for(let l=0,u=a.length;l<u;l++){let d=a[l];this.addGroup(d.start,d.count,d.materialIndex)}let o=e.boundingBox;o!==null&&(this.boundingBox=o.clone());let c=e.boundingSphere;return c!==null&&(this.boundingSphere=c.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Rl=new F,Hp=new F,Wp=new ke,Mn=class{constructor(e=new F(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,i,s){return this.normal.set(e,t,i),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,i){let s=Rl.subVectors(i,t).cross(Hp.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,i=!0){let s=e.delta(Rl),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let a=-(e.start.dot(this.normal)+this.constant)/r;return i===!0&&(a<0||a>1)?null:t.copy(e.start).addScaledVector(s,a)}intersectsLine(e){let t=this.distanceToPoint(e.start),i=this.distanceToPoint(e.end);return t<0&&i>0||i<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let i=t||Wp.getNormalMatrix(e),s=this.coplanarPoint(Rl).applyMatrix4(e),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},Xp=0,ni=class extends kn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Xp++}),this.uuid=Mr(),this.name="",this.type="Material",this.blending=Ts,this.side=Ti,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Wl,this.blendDst=Xl,this.blendEquation=Ki,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Xe(0,0,0),this.blendAlpha=0,this.depthFunc=_s,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Ou,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=pa,this.stencilZFail=pa,this.stencilZPass=pa,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let i=e[t];if(i===void 0){Le(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Le(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(e).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(e).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(e).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(e).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(e).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let a=[];for(let o in r){let c=r[o];delete c.metadata,a.push(c)}return a}if(t){let r=s(e.textures),a=s(e.images);r.length>0&&(i.textures=r),a.length>0&&(i.images=a)}return i}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new Xe().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(i=>new Mn().fromJSON(i))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let i=e.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new je().fromArray(i)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new je().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,i=null;if(t!==null){let s=t.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=t[r].clone()}return this.clippingPlanes=i,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var jn=new F,Cl=new F,jr=new F,Qr=new F,sr=class{constructor(e=new F,t=new F(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,jn)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let i=t.dot(this.direction);return i<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=jn.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(jn.copy(this.origin).addScaledVector(this.direction,t),jn.distanceToSquared(e))}distanceSqToSegment(e,t,i,s){Cl.copy(e).add(t).multiplyScalar(.5),jr.copy(t).sub(e).normalize(),Qr.copy(this.origin).sub(Cl);let r=e.distanceTo(t)*.5,a=-this.direction.dot(jr),o=Qr.dot(this.direction),c=-Qr.dot(jr),l=Qr.lengthSq(),u=Math.abs(1-a*a),d,h,f,g;if(u>0)if(d=a*c-o,h=a*o-c,g=r*u,d>=0)if(h>=-g)if(h<=g){let x=1/u;d*=x,h*=x,f=d*(d+a*h+2*o)+h*(a*d+h+2*c)+l}else h=r,d=Math.max(0,-(a*h+o)),f=-d*d+h*(h+2*c)+l;else h=-r,d=Math.max(0,-(a*h+o)),f=-d*d+h*(h+2*c)+l;else h<=-g?(d=Math.max(0,-(-a*r+o)),h=d>0?-r:Math.min(Math.max(-r,-c),r),f=-d*d+h*(h+2*c)+l):h<=g?(d=0,h=Math.min(Math.max(-r,-c),r),f=h*(h+2*c)+l):(d=Math.max(0,-(a*r+o)),h=d>0?r:Math.min(Math.max(-r,-c),r),f=-d*d+h*(h+2*c)+l);else h=a>0?-r:r,d=Math.max(0,-(a*h+o)),f=-d*d+h*(h+2*c)+l;return i&&i.copy(this.origin).addScaledVector(this.direction,d),s&&s.copy(Cl).addScaledVector(jr,h),f}intersectSphere(e,t){if(e.radius<0)return null;jn.subVectors(e.center,this.origin);let i=jn.dot(this.direction),s=jn.dot(jn)-i*i,r=e.radius*e.radius;if(s>r)return null;let a=Math.sqrt(r-s),o=i-a,c=i+a;return c<0?null:o<0?this.at(c,t):this.at(o,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(e.normal)+e.constant)/t;return i>=0?i:null}intersectPlane(e,t){let i=this.distanceToPlane(e);return i===null?null:this.at(i,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let i,s,r,a,o,c,l=1/this.direction.x,u=1/this.direction.y,d=1/this.direction.z,h=this.origin;return l>=0?(i=(e.min.x-h.x)*l,s=(e.max.x-h.x)*l):(i=(e.max.x-h.x)*l,s=(e.min.x-h.x)*l),u>=0?(r=(e.min.y-h.y)*u,a=(e.max.y-h.y)*u):(r=(e.max.y-h.y)*u,a=(e.min.y-h.y)*u),i>a||r>s||((r>i||isNaN(i))&&(i=r),(a<s||isNaN(s))&&(s=a),d>=0?(o=(e.min.z-h.z)*d,c=(e.max.z-h.z)*d):(o=(e.max.z-h.z)*d,c=(e.min.z-h.z)*d),i>c||o>s)||((o>i||i!==i)&&(i=o),(c<s||s!==s)&&(s=c),s<0)?null:this.at(i>=0?i:s,t)}intersectsBox(e){return this.intersectBox(e,jn)!==null}intersectTriangle(e,t,i,s,r){let a=this.origin,o=this.direction,c=o.x,l=o.y,u=o.z,d=e.x-a.x,h=e.y-a.y,f=e.z-a.z,g=t.x-a.x,x=t.y-a.y,m=t.z-a.z,p=i.x-a.x,v=i.y-a.y,S=i.z-a.z,w=Math.abs(c),T=Math.abs(l),A=Math.abs(u),_,M,U,D,N,B,W,P,H,K,V,ie;if(w>=T&&w>=A?(U=c,B=d,H=g,ie=p,c>=0?(_=l,M=u,D=h,N=f,W=x,P=m,K=v,V=S):(_=u,M=l,D=f,N=h,W=m,P=x,K=S,V=v)):T>=A?(U=l,B=h,H=x,ie=v,l>=0?(_=u,M=c,D=f,N=d,W=m,P=g,K=S,V=p):(_=c,M=u,D=d,N=f,W=g,P=m,K=p,V=S)):(U=u,B=f,H=m,ie=S,u>=0?(_=c,M=l,D=d,N=h,W=g,P=x,K=p,V=v):(_=l,M=c,D=h,N=d,W=x,P=g,K=v,V=p)),U===0)return null;let q=_/U,Q=M/U,ee=1/U,Ae=D-q*B,Be=N-Q*B,$=W-q*H,_e=P-Q*H,ye=K-q*ie,Ie=V-Q*ie,be=ye*_e-Ie*$,Ve=Ae*Ie-Be*ye,Mt=$*Be-_e*Ae;if(s){if(be<0||Ve<0||Mt<0)return null}else if((be<0||Ve<0||Mt<0)&&(be>0||Ve>0||Mt>0))return null;let Fe=be+Ve+Mt;if(Fe===0)return null;let st=ee*(be*B+Ve*H+Mt*ie);return(Fe>0?st<0:st>0)?null:this.at(st/Fe,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},xi=class extends ni{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Xe(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ti,this.combine=Za,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},Jh=new ct,Vi=new sr,ea=new Wi,jh=new F,ta=new F,na=new F,ia=new F,Pl=new F,sa=new F,Qh=new F,ra=new F,Et=class extends Gt{constructor(e=new nn,t=new xi){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}getVertexPosition(e,t){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,a=i.morphTargetsRelative;t.fromBufferAttribute(s,e);let o=this.morphTargetInfluences;if(r&&o){sa.set(0,0,0);for(let c=0,l=r.length;c<l;c++){let u=o[c],d=r[c];u!==0&&(Pl.fromBufferAttribute(d,e),a?sa.addScaledVector(Pl,u):sa.addScaledVector(Pl.sub(t),u))}t.add(sa)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),ea.copy(i.boundingSphere),ea.applyMatrix4(r),Vi.copy(e.ray).recast(e.near),!(ea.containsPoint(Vi.origin)===!1&&(Vi.intersectSphere(ea,jh)===null||Vi.origin.distanceToSquared(jh)>(e.far-e.near)**2))&&(Jh.copy(r).invert(),Vi.copy(e.ray).applyMatrix4(Jh),!(i.boundingBox!==null&&Vi.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(e,t,Vi)))}_computeIntersections(e,t,i){let s,r=this.geometry,a=this.material,o=r.index,c=r.attributes.position,l=r.attributes.uv,u=r.attributes.uv1,d=r.attributes.normal,h=r.groups,f=r.drawRange;if(o!==null)if(Array.isArray(a))for(let g=0,x=h.length;g<x;g++){let m=h[g],p=a[m.materialIndex],v=Math.max(m.start,f.start),S=Math.min(o.count,Math.min(m.start+m.count,f.start+f.count));for(let w=v,T=S;w<T;w+=3){let A=o.getX(w),_=o.getX(w+1),M=o.getX(w+2);s=aa(this,p,e,i,l,u,d,A,_,M),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let g=Math.max(0,f.start),x=Math.min(o.count,f.start+f.count);for(let m=g,p=x;m<p;m+=3){let v=o.getX(m),S=o.getX(m+1),w=o.getX(m+2);s=aa(this,a,e,i,l,u,d,v,S,w),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}else if(c!==void 0)if(Array.isArray(a))for(let g=0,x=h.length;g<x;g++){let m=h[g],p=a[m.materialIndex],v=Math.max(m.start,f.start),S=Math.min(c.count,Math.min(m.start+m.count,f.start+f.count));for(let w=v,T=S;w<T;w+=3){let A=w,_=w+1,M=w+2;s=aa(this,p,e,i,l,u,d,A,_,M),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let g=Math.max(0,f.start),x=Math.min(c.count,f.start+f.count);for(let m=g,p=x;m<p;m+=3){let v=m,S=m+1,w=m+2;s=aa(this,a,e,i,l,u,d,v,S,w),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}}};function qp(n,e,t,i,s,r,a,o){let c;if(e.side===Qt?c=i.intersectTriangle(a,r,s,!0,o):c=i.intersectTriangle(s,r,a,e.side===Ti,o),c===null)return null;ra.copy(o),ra.applyMatrix4(n.matrixWorld);let l=t.ray.origin.distanceTo(ra);return l<t.near||l>t.far?null:{distance:l,point:ra.clone(),object:n}}function aa(n,e,t,i,s,r,a,o,c,l){n.getVertexPosition(o,ta),n.getVertexPosition(c,na),n.getVertexPosition(l,ia);let u=qp(n,e,t,i,ta,na,ia,Qh);if(u){let d=new F;_i.getBarycoord(Qh,ta,na,ia,d),s&&(u.uv=_i.getInterpolatedAttribute(s,o,c,l,d,new je)),r&&(u.uv1=_i.getInterpolatedAttribute(r,o,c,l,d,new je)),a&&(u.normal=_i.getInterpolatedAttribute(a,o,c,l,d,new F),u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1));let h={a:o,b:c,c:l,normal:new F,materialIndex:0};_i.getNormal(ta,na,ia,h.normal),u.face=h,u.barycoord=d}return u}var Ca=class extends jt{constructor(e=null,t=1,i=1,s,r,a,o,c,l=St,u=St,d,h){super(null,a,o,c,l,u,s,r,d,h),this.isDataTexture=!0,this.image={data:e,width:t,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Hi=new Wi,Kp=new je(.5,.5),oa=new F,vi=class{constructor(e=new Mn,t=new Mn,i=new Mn,s=new Mn,r=new Mn,a=new Mn){this.planes=[e,t,i,s,r,a]}set(e,t,i,s,r,a){let o=this.planes;return o[0].copy(e),o[1].copy(t),o[2].copy(i),o[3].copy(s),o[4].copy(r),o[5].copy(a),this}copy(e){let t=this.planes;for(let i=0;i<6;i++)t[i].copy(e.planes[i]);return this}setFromProjectionMatrix(e,t=_n,i=!1){let s=this.planes,r=e.elements,a=r[0],o=r[1],c=r[2],l=r[3],u=r[4],d=r[5],h=r[6],f=r[7],g=r[8],x=r[9],m=r[10],p=r[11],v=r[12],S=r[13],w=r[14],T=r[15];if(s[0].setComponents(l-a,f-u,p-g,T-v).normalize(),s[1].setComponents(l+a,f+u,p+g,T+v).normalize(),s[2].setComponents(l+o,f+d,p+x,T+S).normalize(),s[3].setComponents(l-o,f-d,p-x,T-S).normalize(),i)s[4].setComponents(c,h,m,w).normalize(),s[5].setComponents(l-c,f-h,p-m,T-w).normalize();else if(s[4].setComponents(l-c,f-h,p-m,T-w).normalize(),t===_n)s[5].setComponents(l+c,f+h,p+m,T+w).normalize();else if(t===bs)s[5].setComponents(c,h,m,w).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Hi.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Hi.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Hi)}intersectsSprite(e){Hi.center.set(0,0,0);let t=Kp.distanceTo(e.center);return Hi.radius=.7071067811865476+t,Hi.applyMatrix4(e.matrixWorld),this.intersectsSphere(Hi)}intersectsSphere(e){let t=this.planes,i=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let i=0;i<6;i++){let s=t[i];if(oa.x=s.normal.x>0?e.max.x:e.min.x,oa.y=s.normal.y>0?e.max.y:e.min.y,oa.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(oa)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let i=0;i<6;i++)if(t[i].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},eu=new ct,Pa=class n{constructor(){this.coordinateSystem=_n,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,i=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];eu.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new vi),i[s].setFromProjectionMatrix(eu,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,i=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new vi),t[s].copy(i[s]);return this._count=e._count,this}clone(){return new n().copy(this)}};var ws=class extends ni{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Xe(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Ia=new F,Da=new F,tu=new ct,Ks=new sr,la=new Wi,Il=new F,nu=new F,La=class extends Gt{constructor(e=new nn,t=new ws){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[0];for(let s=1,r=t.count;s<r;s++)Ia.fromBufferAttribute(t,s-1),Da.fromBufferAttribute(t,s),i[s]=i[s-1],i[s]+=Ia.distanceTo(Da);e.setAttribute("lineDistance",new wt(i,1))}else Le("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,a=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),la.copy(i.boundingSphere),la.applyMatrix4(s),la.radius+=r,e.ray.intersectsSphere(la)===!1)return;tu.copy(s).invert(),Ks.copy(e.ray).applyMatrix4(tu);let o=r/((this.scale.x+this.scale.y+this.scale.z)/3),c=o*o,l=this.isLineSegments?2:1,u=i.index,h=i.attributes.position;if(u!==null){let f=Math.max(0,a.start),g=Math.min(u.count,a.start+a.count);for(let x=f,m=g-1;x<m;x+=l){let p=u.getX(x),v=u.getX(x+1),S=ca(this,e,Ks,c,p,v,x);S&&t.push(S)}if(this.isLineLoop){let x=u.getX(g-1),m=u.getX(f),p=ca(this,e,Ks,c,x,m,g-1);p&&t.push(p)}}else{let f=Math.max(0,a.start),g=Math.min(h.count,a.start+a.count);for(let x=f,m=g-1;x<m;x+=l){let p=ca(this,e,Ks,c,x,x+1,x);p&&t.push(p)}if(this.isLineLoop){let x=ca(this,e,Ks,c,g-1,f,g-1);x&&t.push(x)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){let o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}};function ca(n,e,t,i,s,r,a){let o=n.geometry.attributes.position;if(Ia.fromBufferAttribute(o,s),Da.fromBufferAttribute(o,r),t.distanceSqToSegment(Ia,Da,Il,nu)>i)return;Il.applyMatrix4(n.matrixWorld);let l=e.ray.origin.distanceTo(Il);if(!(l<e.near||l>e.far))return{distance:l,point:nu.clone().applyMatrix4(n.matrixWorld),index:a,face:null,faceIndex:null,barycoord:null,object:n}}var iu=new F,su=new F,rr=class extends La{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[];for(let s=0,r=t.count;s<r;s+=2)iu.fromBufferAttribute(t,s),su.fromBufferAttribute(t,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+iu.distanceTo(su);e.setAttribute("lineDistance",new wt(i,1))}else Le("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var ar=class extends jt{constructor(e=[],t=Yi,i,s,r,a,o,c,l,u){super(e,t,i,s,r,a,o,c,l,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},or=class extends jt{constructor(e,t,i,s,r,a,o,c,l){super(e,t,i,s,r,a,o,c,l),this.isCanvasTexture=!0,this.needsUpdate=!0}};var ii=class extends jt{constructor(e,t,i=An,s,r,a,o=St,c=St,l,u=ei,d=1){if(u!==ei&&u!==ai)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let h={width:e,height:t,depth:d};super(h,s,r,a,o,c,u,i,l),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new vs(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},lr=class extends ii{constructor(e,t=An,i=Yi,s,r,a=St,o=St,c,l=ei){let u={width:e,height:e,depth:1},d=[u,u,u,u,u,u];super(e,e,t,i,s,r,a,o,c,l),this.image=d,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},cr=class extends jt{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},Ss=class n extends nn{constructor(e=1,t=1,i=1,s=1,r=1,a=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:i,widthSegments:s,heightSegments:r,depthSegments:a};let o=this;s=Math.floor(s),r=Math.floor(r),a=Math.floor(a);let c=[],l=[],u=[],d=[],h=0,f=0;g("z","y","x",-1,-1,i,t,e,a,r,0),g("z","y","x",1,-1,i,t,-e,a,r,1),g("x","z","y",1,1,e,i,t,s,a,2),g("x","z","y",1,-1,e,i,-t,s,a,3),g("x","y","z",1,-1,e,t,i,s,r,4),g("x","y","z",-1,-1,e,t,-i,s,r,5),this.setIndex(c),this.setAttribute("position",new wt(l,3)),this.setAttribute("normal",new wt(u,3)),this.setAttribute("uv",new wt(d,2));function g(x,m,p,v,S,w,T,A,_,M,U){let D=w/_,N=T/M,B=w/2,W=T/2,P=A/2,H=_+1,K=M+1,V=0,ie=0,q=new F;for(let Q=0;Q<K;Q++){let ee=Q*N-W;for(let Ae=0;Ae<H;Ae++){let Be=Ae*D-B;q[x]=Be*v,q[m]=ee*S,q[p]=P,l.push(q.x,q.y,q.z),q[x]=0,q[m]=0,q[p]=A>0?1:-1,u.push(q.x,q.y,q.z),d.push(Ae/_),d.push(1-Q/M),V+=1}}for(let Q=0;Q<M;Q++)for(let ee=0;ee<_;ee++){let Ae=h+ee+H*Q,Be=h+ee+H*(Q+1),$=h+(ee+1)+H*(Q+1),_e=h+(ee+1)+H*Q;c.push(Ae,Be,_e),c.push(Be,$,_e),ie+=6}o.addGroup(f,ie,U),f+=ie,h+=V}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var yi=class n extends nn{constructor(e=1,t=1,i=1,s=32,r=1,a=!1,o=0,c=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:i,radialSegments:s,heightSegments:r,openEnded:a,thetaStart:o,thetaLength:c};let l=this;s=Math.floor(s),r=Math.floor(r);let u=[],d=[],h=[],f=[],g=0,x=[],m=i/2,p=0;v(),a===!1&&(e>0&&S(!0),t>0&&S(!1)),this.setIndex(u),this.setAttribute("position",new wt(d,3)),this.setAttribute("normal",new wt(h,3)),this.setAttribute("uv",new wt(f,2));function v(){let w=new F,T=new F,A=0,_=(t-e)/i;for(let M=0;M<=r;M++){let U=[],D=M/r,N=D*(t-e)+e;for(let B=0;B<=s;B++){let W=B/s,P=W*c+o,H=Math.sin(P),K=Math.cos(P);T.x=N*H,T.y=-D*i+m,T.z=N*K,d.push(T.x,T.y,T.z),w.set(H,_,K).normalize(),h.push(w.x,w.y,w.z),f.push(W,1-D),U.push(g++)}x.push(U)}for(let M=0;M<s;M++)for(let U=0;U<r;U++){let D=x[U][M],N=x[U+1][M],B=x[U+1][M+1],W=x[U][M+1];(e>0||U!==0)&&(u.push(D,N,W),A+=3),(t>0||U!==r-1)&&(u.push(N,B,W),A+=3)}l.addGroup(p,A,0),p+=A}function S(w){let T=g,A=new je,_=new F,M=0,U=w===!0?e:t,D=w===!0?1:-1;for(let B=1;B<=s;B++)d.push(0,m*D,0),h.push(0,D,0),f.push(.5,.5),g++;let N=g;for(let B=0;B<=s;B++){let P=B/s*c+o,H=Math.cos(P),K=Math.sin(P);_.x=U*K,_.y=m*D,_.z=U*H,d.push(_.x,_.y,_.z),h.push(0,D,0),A.x=H*.5+.5,A.y=K*.5*D+.5,f.push(A.x,A.y),g++}for(let B=0;B<s;B++){let W=T+B,P=N+B;w===!0?u.push(P,P+1,W):u.push(P+1,P,W),M+=3}l.addGroup(p,M,w===!0?1:2),p+=M}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var Xi=class n extends nn{constructor(e=1,t=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:i,heightSegments:s};let r=e/2,a=t/2,o=Math.floor(i),c=Math.floor(s),l=o+1,u=c+1,d=e/o,h=t/c,f=[],g=[],x=[],m=[];for(let p=0;p<u;p++){let v=p*h-a;for(let S=0;S<l;S++){let w=S*d-r;g.push(w,-v,0),x.push(0,0,1),m.push(S/o),m.push(1-p/c)}}for(let p=0;p<c;p++)for(let v=0;v<o;v++){let S=v+l*p,w=v+l*(p+1),T=v+1+l*(p+1),A=v+1+l*p;f.push(S,w,A),f.push(w,T,A)}this.setIndex(f),this.setAttribute("position",new wt(g,3)),this.setAttribute("normal",new wt(x,3)),this.setAttribute("uv",new wt(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.widthSegments,e.heightSegments)}};var wi=class n extends nn{constructor(e=1,t=32,i=16,s=0,r=Math.PI*2,a=0,o=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:i,phiStart:s,phiLength:r,thetaStart:a,thetaLength:o},t=Math.max(3,Math.floor(t)),i=Math.max(2,Math.floor(i));let c=Math.min(a+o,Math.PI),l=0,u=[],d=new F,h=new F,f=[],g=[],x=[],m=[];for(let p=0;p<=i;p++){let v=[],S=p/i,w=a+S*o,T=e*Math.cos(w),A=Math.sqrt(e*e-T*T),_=0;p===0&&a===0?_=.5/t:p===i&&c===Math.PI&&(_=-.5/t);for(let M=0;M<=t;M++){let U=M/t,D=s+U*r;d.x=-A*Math.cos(D),d.y=T,d.z=A*Math.sin(D),g.push(d.x,d.y,d.z),h.copy(d).normalize(),x.push(h.x,h.y,h.z),m.push(U+_,1-S),v.push(l++)}u.push(v)}for(let p=0;p<i;p++)for(let v=0;v<t;v++){let S=u[p][v+1],w=u[p][v],T=u[p+1][v],A=u[p+1][v+1];(p!==0||a>0)&&f.push(S,w,A),(p!==i-1||c<Math.PI)&&f.push(w,T,A)}this.setIndex(f),this.setAttribute("position",new wt(g,3)),this.setAttribute("normal",new wt(x,3)),this.setAttribute("uv",new wt(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function $i(n){let e={};for(let t in n){e[t]={};for(let i in n[t]){let s=n[t][i];if(ru(s))s.isRenderTargetTexture?(Le("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][i]=null):e[t][i]=s.clone();else if(Array.isArray(s))if(ru(s[0])){let r=[];for(let a=0,o=s.length;a<o;a++)r[a]=s[a].clone();e[t][i]=r}else e[t][i]=s.slice();else e[t][i]=s}}return e}function qt(n){let e={};for(let t=0;t<n.length;t++){let i=$i(n[t]);for(let s in i)e[s]=i[s]}return e}function ru(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function Yp(n){let e=[];for(let t=0;t<n.length;t++)e.push(n[t].clone());return e}function fc(n){let e=n.getRenderTarget();return e===null?n.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:Je.workingColorSpace}var Ju={clone:$i,merge:qt},Zp=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,$p=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,On=class extends ni{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Zp,this.fragmentShader=$p,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=$i(e.uniforms),this.uniformsGroups=Yp(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let a=this.uniforms[s].value;a&&a.isTexture?t.uniforms[s]={type:"t",value:a.toJSON(e).uuid}:a&&a.isColor?t.uniforms[s]={type:"c",value:a.getHex()}:a&&a.isVector2?t.uniforms[s]={type:"v2",value:a.toArray()}:a&&a.isVector3?t.uniforms[s]={type:"v3",value:a.toArray()}:a&&a.isVector4?t.uniforms[s]={type:"v4",value:a.toArray()}:a&&a.isMatrix3?t.uniforms[s]={type:"m3",value:a.toArray()}:a&&a.isMatrix4?t.uniforms[s]={type:"m4",value:a.toArray()}:t.uniforms[s]={value:a}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(t.extensions=i),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let i in e.uniforms){let s=e.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=t[s.value]||null;break;case"c":this.uniforms[i].value=new Xe().setHex(s.value);break;case"v2":this.uniforms[i].value=new je().fromArray(s.value);break;case"v3":this.uniforms[i].value=new F().fromArray(s.value);break;case"v4":this.uniforms[i].value=new xt().fromArray(s.value);break;case"m3":this.uniforms[i].value=new ke().fromArray(s.value);break;case"m4":this.uniforms[i].value=new ct().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let i in e.extensions)this.extensions[i]=e.extensions[i];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Na=class extends On{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var si=class extends ni{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Xe(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Xe(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Uo,this.normalScale=new je(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ti,this.combine=Za,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},Fa=class extends ni{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Uu,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},Ua=class extends ni{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function fs(n,e){return!n||n.constructor===e?n:typeof e.BYTES_PER_ELEMENT=="number"?new e(n):Array.prototype.slice.call(n)}function ha(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var Si=class{constructor(e,t,i,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(i),this.sampleValues=t,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,i=this._cachedIndex,s=t[i],r=t[i-1];n:{e:{let a;t:{i:if(!(e<s)){for(let o=i+2;;){if(s===void 0){if(e<r)break i;return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===o)break;if(r=s,s=t[++i],e<s)break e}a=t.length;break t}if(!(e>=r)){let o=t[1];e<o&&(i=2,r=o);for(let c=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===c)break;if(s=r,r=t[--i-1],e>=r)break e}a=i,i=0;break t}break n}for(;i<a;){let o=i+a>>>1;e<t[o]?a=o:i=o+1}if(s=t[i],r=t[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=e*s;for(let a=0;a!==s;++a)t[a]=i[r+a];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},ka=class extends Si{constructor(e,t,i,s){super(e,t,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Nl,endingEnd:Nl}}intervalChanged_(e,t,i){let s=this.parameterPositions,r=e-2,a=e+1,o=s[r],c=s[a];if(o===void 0)switch(this.getSettings_().endingStart){case Fl:r=e,o=2*t-i;break;case Ul:r=s.length-2,o=t+s[r]-s[r+1];break;default:r=e,o=i}if(c===void 0)switch(this.getSettings_().endingEnd){case Fl:a=e,c=2*i-t;break;case Ul:a=1,c=i+s[1]-s[0];break;default:a=e-1,c=t}let l=(i-t)*.5,u=this.valueSize;this._weightPrev=l/(t-o),this._weightNext=l/(c-i),this._offsetPrev=r*u,this._offsetNext=a*u}interpolate_(e,t,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,c=e*o,l=c-o,u=this._offsetPrev,d=this._offsetNext,h=this._weightPrev,f=this._weightNext,g=(i-t)/(s-t),x=g*g,m=x*g,p=-h*m+2*h*x-h*g,v=(1+h)*m+(-1.5-2*h)*x+(-.5+h)*g+1,S=(-1-f)*m+(1.5+f)*x+.5*g,w=f*m-f*x;for(let T=0;T!==o;++T)r[T]=p*a[u+T]+v*a[l+T]+S*a[c+T]+w*a[d+T];return r}},Oa=class extends Si{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,c=e*o,l=c-o,u=(i-t)/(s-t),d=1-u;for(let h=0;h!==o;++h)r[h]=a[l+h]*d+a[c+h]*u;return r}},Ba=class extends Si{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e){return this.copySampleValue_(e-1)}},za=class extends Si{interpolate_(e,t,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,c=e*o,l=c-o,u=this.inTangents,d=this.outTangents;if(!u||!d){let g=(i-t)/(s-t),x=1-g;for(let m=0;m!==o;++m)r[m]=a[l+m]*x+a[c+m]*g;return r}let h=o*2,f=e-1;for(let g=0;g!==o;++g){let x=a[l+g],m=a[c+g],p=f*h+g*2,v=d[p],S=d[p+1],w=e*h+g*2,T=u[w],A=u[w+1],_=jp(i,t,v,T,s);r[g]=ju(_,x,S,A,m)}return r}};function ju(n,e,t,i,s){let r=1-n;return r*r*r*e+3*r*r*n*t+3*r*n*n*i+n*n*n*s}function Jp(n,e,t,i,s){let r=1-n;return 3*r*r*(t-e)+6*r*n*(i-t)+3*n*n*(s-i)}function jp(n,e,t,i,s){let r=(n-e)/(s-e);for(let a=0;a<8;a++){let o=ju(r,e,t,i,s)-n;if(Math.abs(o)<1e-10)break;let c=Jp(r,e,t,i,s);if(Math.abs(c)<1e-10)break;r=Math.max(0,Math.min(1,r-o/c))}return r}var un=class{constructor(e,t,i,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=fs(t,this.TimeBufferType),this.values=fs(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,i;if(t.toJSON!==this.toJSON)i=t.toJSON(e);else{i={name:e.name,times:fs(e.times,Array),values:fs(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(i.interpolation=s),ha(e.settings)&&(i.settings={inTangents:fs(e.settings.inTangents,Array),outTangents:fs(e.settings.outTangents,Array)})}return i.type=e.ValueTypeName,i}InterpolantFactoryMethodDiscrete(e){return new Ba(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new Oa(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new ka(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new za(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Zs:t=this.InterpolantFactoryMethodDiscrete;break;case Ma:t=this.InterpolantFactoryMethodLinear;break;case fa:t=this.InterpolantFactoryMethodSmooth;break;case Ll:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Le("KeyframeTrack:",i),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Zs;case this.InterpolantFactoryMethodLinear:return Ma;case this.InterpolantFactoryMethodSmooth:return fa;case this.InterpolantFactoryMethodBezier:return Ll}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]+=e;ha(this.settings)&&(au(this.settings.inTangents,e),au(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]*=e;ha(this.settings)&&(ou(this.settings.inTangents,e),ou(this.settings.outTangents,e))}return this}trim(e,t){let i=this.times,s=i.length,r=0,a=s-1;for(;r!==s&&i[r]<e;)++r;for(;a!==-1&&i[a]>t;)--a;if(++a,r!==0||a!==s){r>=a&&(a=Math.max(a,1),r=a-1);let o=this.getValueSize();this.times=i.slice(r,a),this.values=this.values.slice(r*o,a*o)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(Ue("KeyframeTrack: Invalid value size in track.",this),e=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Ue("KeyframeTrack: Track is empty.",this),e=!1);let a=null;for(let o=0;o!==r;o++){let c=i[o];if(typeof c=="number"&&isNaN(c)){Ue("KeyframeTrack: Time is not a valid number.",this,o,c),e=!1;break}if(a!==null&&a>c){Ue("KeyframeTrack: Out of order keys.",this,o,c,a),e=!1;break}a=c}if(s!==void 0&&Tp(s))for(let o=0,c=s.length;o!==c;++o){let l=s[o];if(isNaN(l)){Ue("KeyframeTrack: Value is not a valid number.",this,o,l),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===fa,r=e.length-1,a=1;for(let o=1;o<r;++o){let c=!1,l=e[o],u=e[o+1];if(l!==u&&(o!==1||l!==e[0]))if(s)c=!0;else{let d=o*i,h=d-i,f=d+i;for(let g=0;g!==i;++g){let x=t[d+g];if(x!==t[h+g]||x!==t[f+g]){c=!0;break}}}if(c){if(o!==a){e[a]=e[o];let d=o*i,h=a*i;for(let f=0;f!==i;++f)t[h+f]=t[d+f]}++a}}if(r>0){e[a]=e[r];for(let o=r*i,c=a*i,l=0;l!==i;++l)t[c+l]=t[o+l];++a}return a!==e.length?(this.times=e.slice(0,a),this.values=t.slice(0,a*i)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),i=this.constructor,s=new i(this.name,e,t);return s.createInterpolant=this.createInterpolant,ha(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function au(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]+=e}function ou(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]*=e}un.prototype.ValueTypeName="";un.prototype.TimeBufferType=Float32Array;un.prototype.ValueBufferType=Float32Array;un.prototype.DefaultInterpolation=Ma;var Mi=class extends un{constructor(e,t,i){super(e,t,i)}};Mi.prototype.ValueTypeName="bool";Mi.prototype.ValueBufferType=Array;Mi.prototype.DefaultInterpolation=Zs;Mi.prototype.InterpolantFactoryMethodLinear=void 0;Mi.prototype.InterpolantFactoryMethodSmooth=void 0;var Ga=class extends un{constructor(e,t,i,s){super(e,t,i,s)}};Ga.prototype.ValueTypeName="color";var Va=class extends un{constructor(e,t,i,s){super(e,t,i,s)}};Va.prototype.ValueTypeName="number";var Ha=class extends Si{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,a=this.sampleValues,o=this.valueSize,c=(i-t)/(s-t),l=e*o;for(let u=l+o;l!==u;l+=4)bn.slerpFlat(r,0,a,l-o,a,l,c);return r}},hr=class extends un{constructor(e,t,i,s){super(e,t,i,s)}InterpolantFactoryMethodLinear(e){return new Ha(this.times,this.values,this.getValueSize(),e)}};hr.prototype.ValueTypeName="quaternion";hr.prototype.InterpolantFactoryMethodSmooth=void 0;var Ai=class extends un{constructor(e,t,i){super(e,t,i)}};Ai.prototype.ValueTypeName="string";Ai.prototype.ValueBufferType=Array;Ai.prototype.DefaultInterpolation=Zs;Ai.prototype.InterpolantFactoryMethodLinear=void 0;Ai.prototype.InterpolantFactoryMethodSmooth=void 0;var Wa=class extends un{constructor(e,t,i,s){super(e,t,i,s)}};Wa.prototype.ValueTypeName="vector";var Xa=class{constructor(e,t,i){let s=this,r=!1,a=0,o=0,c,l=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=i,this._abortController=null,this.itemStart=function(u){o++,r===!1&&s.onStart!==void 0&&s.onStart(u,a,o),r=!0},this.itemEnd=function(u){a++,s.onProgress!==void 0&&s.onProgress(u,a,o),a===o&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(u){s.onError!==void 0&&s.onError(u)},this.resolveURL=function(u){return u=u.normalize("NFC"),c?c(u):u},this.setURLModifier=function(u){return c=u,this},this.addHandler=function(u,d){return l.push(u,d),this},this.removeHandler=function(u){let d=l.indexOf(u);return d!==-1&&l.splice(d,2),this},this.getHandler=function(u){for(let d=0,h=l.length;d<h;d+=2){let f=l[d],g=l[d+1];if(f.global&&(f.lastIndex=0),f.test(u))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Qu=new Xa,qa=class{constructor(e){this.manager=e!==void 0?e:Qu,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let i=this;return new Promise(function(s,r){i.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};qa.DEFAULT_MATERIAL_NAME="__DEFAULT";var ur=class extends Gt{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new Xe(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},dr=class extends ur{constructor(e,t,i){super(e,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Gt.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Xe(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Dl=new ct,lu=new F,cu=new F,Ka=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new je(512,512),this.mapType=rn,this.map=null,this.mapPass=null,this.matrix=new ct,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new vi,this._frameExtents=new je(1,1),this._viewportCount=1,this._viewports=[new xt(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;lu.setFromMatrixPosition(e.matrixWorld),t.position.copy(lu),cu.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(cu),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,i,s){Dl.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),i.setFromProjectionMatrix(Dl,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,a=s?s.z/r.x:1,o=s?s.w/r.y:1,c=s?s.x/r.x:0,l=s?s.y/r.y:0;e.coordinateSystem===bs||e.reversedDepth?t.set(.5*a,0,0,.5*a+c,0,.5*o,0,.5*o+l,0,0,1,0,0,0,0,1):t.set(.5*a,0,0,.5*a+c,0,.5*o,0,.5*o+l,0,0,.5,.5,0,0,0,1),t.multiply(Dl)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},ua=new F,da=new bn,Nn=new F,fr=class extends Gt{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new ct,this.projectionMatrix=new ct,this.projectionMatrixInverse=new ct,this.coordinateSystem=_n,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(ua,da,Nn),Nn.x===1&&Nn.y===1&&Nn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ua,da,Nn.set(1,1,1)).invert()}updateWorldMatrix(e,t,i=!1){super.updateWorldMatrix(e,t,i),this.matrixWorld.decompose(ua,da,Nn),Nn.x===1&&Nn.y===1&&Nn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ua,da,Nn.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},gi=new F,hu=new je,uu=new je,$t=class extends fr{constructor(e=50,t=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Aa*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(hl*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Aa*2*Math.atan(Math.tan(hl*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,i){gi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(gi.x,gi.y).multiplyScalar(-e/gi.z),gi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(gi.x,gi.y).multiplyScalar(-e/gi.z)}getViewSize(e,t){return this.getViewBounds(e,hu,uu),t.subVectors(uu,hu)}setViewOffset(e,t,i,s,r,a){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(hl*.5*this.fov)/this.zoom,i=2*t,s=this.aspect*i,r=-.5*s,a=this.view;if(this.view!==null&&this.view.enabled){let c=a.fullWidth,l=a.fullHeight;r+=a.offsetX*s/c,t-=a.offsetY*i/l,s*=a.width/c,i*=a.height/l}let o=this.filmOffset;o!==0&&(r+=e*o/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-i,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var pr=class extends fr{constructor(e=-1,t=1,i=1,s=-1,r=.1,a=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=i,this.bottom=s,this.near=r,this.far=a,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,i,s,r,a){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-e,a=i+e,o=s+t,c=s-t;if(this.view!==null&&this.view.enabled){let l=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=l*this.view.offsetX,a=r+l*this.view.width,o-=u*this.view.offsetY,c=o-u*this.view.height}this.projectionMatrix.makeOrthographic(r,a,o,c,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},kl=class extends Ka{constructor(){super(new pr(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},mr=class extends ur{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Gt.DEFAULT_UP),this.updateMatrix(),this.target=new Gt,this.shadow=new kl}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var ps=-90,ms=1,Ms=class extends Gt{constructor(e,t,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new $t(ps,ms,e,t);s.layers=this.layers,this.add(s);let r=new $t(ps,ms,e,t);r.layers=this.layers,this.add(r);let a=new $t(ps,ms,e,t);a.layers=this.layers,this.add(a);let o=new $t(ps,ms,e,t);o.layers=this.layers,this.add(o);let c=new $t(ps,ms,e,t);c.layers=this.layers,this.add(c);let l=new $t(ps,ms,e,t);l.layers=this.layers,this.add(l)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[i,s,r,a,o,c]=t;for(let l of t)this.remove(l);if(e===_n)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),a.up.set(0,0,1),a.lookAt(0,-1,0),o.up.set(0,1,0),o.lookAt(0,0,1),c.up.set(0,1,0),c.lookAt(0,0,-1);else if(e===bs)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),a.up.set(0,0,-1),a.lookAt(0,-1,0),o.up.set(0,-1,0),o.lookAt(0,0,1),c.up.set(0,-1,0),c.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let l of t)this.add(l),l.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,a,o,c,l,u]=this.children,d=e.getRenderTarget(),h=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),g=e.xr.enabled;e.xr.enabled=!1;let x=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let m=!1;e.isWebGLRenderer===!0?m=e.state.buffers.depth.getReversed():m=e.reversedDepthBuffer,e.setRenderTarget(i,0,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(i,1,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(i,2,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(i,3,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),e.setRenderTarget(i,4,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),i.texture.mipmapsAutoUpdate=x,e.setRenderTarget(i,5,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,u),e.setRenderTarget(d,h,f),e.xr.enabled=g,i.texture.needsPMREMUpdate=!0}},Ya=class extends $t{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var pc="\\[\\]\\.:\\/",Qp=new RegExp("["+pc+"]","g"),mc="[^"+pc+"]",em="[^"+pc.replace("\\.","")+"]",tm=/((?:WC+[\/:])*)/.source.replace("WC",mc),nm=/(WCOD+)?/.source.replace("WCOD",em),im=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",mc),sm=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",mc),rm=new RegExp("^"+tm+nm+im+sm+"$"),am=["material","materials","bones","map"],Ol=class{constructor(e,t,i){let s=i||pt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(e,t)}setValue(e,t){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].unbind()}},pt=class n{constructor(e,t,i){this.path=t,this.parsedPath=i||n.parseTrackName(t),this.node=n.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,i){return e&&e.isAnimationObjectGroup?new n.Composite(e,t,i):new n(e,t,i)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Qp,"")}static parseTrackName(e){let t=rm.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let i={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);am.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return i}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let i=e.skeleton.getBoneByName(t);if(i!==void 0)return i}if(e.children){let i=function(r){for(let a=0;a<r.length;a++){let o=r[a];if(o.name===t||o.uuid===t)return o;let c=i(o.children);if(c)return c}return null},s=i(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)e[t++]=i[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,i=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=n.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Le("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let l=t.objectIndex;switch(i){case"materials":if(!e.material){Ue("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){Ue("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){Ue("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let u=0;u<e.length;u++)if(e[u].name===l){l=u;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){Ue("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){Ue("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[i]===void 0){Ue("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[i]}if(l!==void 0){if(e[l]===void 0){Ue("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[l]}}let a=e[s];if(a===void 0){let l=t.nodeName;Ue("PropertyBinding: Trying to update property for track: "+l+"."+s+" but it wasn't found.",e);return}let o=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?o=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(o=this.Versioning.MatrixWorldNeedsUpdate);let c=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){Ue("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){Ue("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}c=this.BindingType.ArrayElement,this.resolvedProperty=a,this.propertyIndex=r}else a.fromArray!==void 0&&a.toArray!==void 0?(c=this.BindingType.HasFromToArray,this.resolvedProperty=a):Array.isArray(a)?(c=this.BindingType.EntireArray,this.resolvedProperty=a):this.propertyName=s;this.getValue=this.GetterByBindingType[c],this.setValue=this.SetterByBindingTypeAndVersioning[c][o]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};pt.Composite=Ol;pt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};pt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};pt.prototype.GetterByBindingType=[pt.prototype._getValue_direct,pt.prototype._getValue_array,pt.prototype._getValue_arrayElement,pt.prototype._getValue_toArray];pt.prototype.SetterByBindingTypeAndVersioning=[[pt.prototype._setValue_direct,pt.prototype._setValue_direct_setNeedsUpdate,pt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[pt.prototype._setValue_array,pt.prototype._setValue_array_setNeedsUpdate,pt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[pt.prototype._setValue_arrayElement,pt.prototype._setValue_arrayElement_setNeedsUpdate,pt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[pt.prototype._setValue_fromArray,pt.prototype._setValue_fromArray_setNeedsUpdate,pt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var my=new Float32Array(1);var Bl=class{static{this.prototype.isMatrix2=!0}constructor(e,t,i,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let i=0;i<4;i++)this.elements[i]=e[i+t];return this}set(e,t,i,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=i,r[3]=s,this}};function gc(n,e,t,i){let s=om(i);switch(t){case sc:return n*e;case ac:return n*e/s.components*s.byteLength;case no:return n*e/s.components*s.byteLength;case Ei:return n*e*2/s.components*s.byteLength;case io:return n*e*2/s.components*s.byteLength;case rc:return n*e*3/s.components*s.byteLength;case Rn:return n*e*4/s.components*s.byteLength;case so:return n*e*4/s.components*s.byteLength;case br:case xr:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case vr:case yr:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case ao:case lo:return Math.max(n,16)*Math.max(e,8)/4;case ro:case oo:return Math.max(n,8)*Math.max(e,8)/2;case co:case ho:case fo:case po:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case uo:case wr:case mo:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case go:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case _o:return Math.floor((n+4)/5)*Math.floor((e+3)/4)*16;case bo:return Math.floor((n+4)/5)*Math.floor((e+4)/5)*16;case xo:return Math.floor((n+5)/6)*Math.floor((e+4)/5)*16;case vo:return Math.floor((n+5)/6)*Math.floor((e+5)/6)*16;case yo:return Math.floor((n+7)/8)*Math.floor((e+4)/5)*16;case wo:return Math.floor((n+7)/8)*Math.floor((e+5)/6)*16;case So:return Math.floor((n+7)/8)*Math.floor((e+7)/8)*16;case Mo:return Math.floor((n+9)/10)*Math.floor((e+4)/5)*16;case Ao:return Math.floor((n+9)/10)*Math.floor((e+5)/6)*16;case To:return Math.floor((n+9)/10)*Math.floor((e+7)/8)*16;case Eo:return Math.floor((n+9)/10)*Math.floor((e+9)/10)*16;case Ro:return Math.floor((n+11)/12)*Math.floor((e+9)/10)*16;case Co:return Math.floor((n+11)/12)*Math.floor((e+11)/12)*16;case Po:case Io:case Do:return Math.ceil(n/4)*Math.ceil(e/4)*16;case Lo:case No:return Math.ceil(n/4)*Math.ceil(e/4)*8;case Sr:case Fo:return Math.ceil(n/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function om(n){switch(n){case rn:case ec:return{byteLength:1,components:1};case Rs:case tc:case En:return{byteLength:2,components:1};case eo:case to:return{byteLength:2,components:4};case An:case Qa:case Tn:return{byteLength:4,components:1};case nc:case ic:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Le("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */function yd(){let n=null,e=!1,t=null,i=null;function s(r,a){i=n.requestAnimationFrame(s),t(r,a)}return{start:function(){e!==!0&&t!==null&&n!==null&&(i=n.requestAnimationFrame(s),e=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){n=r}}}function cm(n){let e=new WeakMap;function t(o,c){let l=o.array,u=o.usage,d=l.byteLength,h=n.createBuffer();n.bindBuffer(c,h),n.bufferData(c,l,u),o.onUploadCallback();let f;if(l instanceof Float32Array)f=n.FLOAT;else if(typeof Float16Array<"u"&&l instanceof Float16Array)f=n.HALF_FLOAT;else if(l instanceof Uint16Array)o.isFloat16BufferAttribute?f=n.HALF_FLOAT:f=n.UNSIGNED_SHORT;else if(l instanceof Int16Array)f=n.SHORT;else if(l instanceof Uint32Array)f=n.UNSIGNED_INT;else if(l instanceof Int32Array)f=n.INT;else if(l instanceof Int8Array)f=n.BYTE;else if(l instanceof Uint8Array)f=n.UNSIGNED_BYTE;else if(l instanceof Uint8ClampedArray)f=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+l);return{buffer:h,type:f,bytesPerElement:l.BYTES_PER_ELEMENT,version:o.version,size:d}}function i(o,c,l){let u=c.array,d=c.updateRanges;if(n.bindBuffer(l,o),d.length===0)n.bufferSubData(l,0,u);else{d.sort((f,g)=>f.start-g.start);let h=0;for(let f=1;f<d.length;f++){let g=d[h],x=d[f];x.start<=g.start+g.count+1?g.count=Math.max(g.count,x.start+x.count-g.start):(++h,d[h]=x)}d.length=h+1;for(let f=0,g=d.length;f<g;f++){let x=d[f];n.bufferSubData(l,x.start*u.BYTES_PER_ELEMENT,u,x.start,x.count)}c.clearUpdateRanges()}c.onUploadCallback()}function s(o){return o.isInterleavedBufferAttribute&&(o=o.data),e.get(o)}function r(o){o.isInterleavedBufferAttribute&&(o=o.data);let c=e.get(o);c&&(n.deleteBuffer(c.buffer),e.delete(o))}function a(o,c){if(o.isInterleavedBufferAttribute&&(o=o.data),o.isGLBufferAttribute){let u=e.get(o);(!u||u.version<o.version)&&e.set(o,{buffer:o.buffer,type:o.type,bytesPerElement:o.elementSize,version:o.version});return}let l=e.get(o);if(l===void 0)e.set(o,t(o,c));else if(l.version<o.version){if(l.size!==o.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(l.buffer,o,c),l.version=o.version}}return{get:s,remove:r,update:a}}var hm=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,um=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,dm=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,fm=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,pm=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,mm=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,gm=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,_m=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,bm=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,xm=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,vm=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,ym=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,wm=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Sm=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Mm=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Am=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Tm=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Em=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Rm=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Cm=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Pm=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Im=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Dm=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Lm=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Nm=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Fm=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Um=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,km=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Om=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Bm="gl_FragColor = linearToOutputTexel( gl_FragColor );",zm=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Gm=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Vm=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,Hm=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Wm=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Xm=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,qm=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Km=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,Ym=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Zm=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,$m=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Jm=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,jm=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Qm=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,eg=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,tg=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,ng=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,ig=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,sg=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,rg=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,ag=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,og=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,lg=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,cg=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,hg=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,ug=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,dg=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,fg=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,pg=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,mg=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,gg=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,_g=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,bg=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,xg=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,vg=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,yg=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,wg=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Sg=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,Mg=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Ag=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Tg=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Eg=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Rg=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Cg=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Pg=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Ig=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,Dg=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Lg=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Ng=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Fg=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Ug=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,kg=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Og=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Bg=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,zg=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Gg=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Vg=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Hg=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Wg=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Xg=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,qg=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Kg=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Yg=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Zg=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,$g=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Jg=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,jg=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Qg=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,e_=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,t_=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,n_=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,i_=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,s_=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,r_=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,a_=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,o_=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,l_=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,c_=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,h_=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,u_=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,d_=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,f_=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,p_=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,m_=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,g_=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,__=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,b_=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,x_=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,v_=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,y_=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,w_=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,S_=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,M_=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,A_=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,T_=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,E_=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,R_=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,C_=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,P_=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,I_=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,D_=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,L_=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,N_=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,F_=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,U_=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,k_=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,O_=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,B_=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,z_=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,G_=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,V_=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,qe={alphahash_fragment:hm,alphahash_pars_fragment:um,alphamap_fragment:dm,alphamap_pars_fragment:fm,alphatest_fragment:pm,alphatest_pars_fragment:mm,aomap_fragment:gm,aomap_pars_fragment:_m,batching_pars_vertex:bm,batching_vertex:xm,begin_vertex:vm,beginnormal_vertex:ym,bsdfs:wm,iridescence_fragment:Sm,bumpmap_pars_fragment:Mm,clipping_planes_fragment:Am,clipping_planes_pars_fragment:Tm,clipping_planes_pars_vertex:Em,clipping_planes_vertex:Rm,color_fragment:Cm,color_pars_fragment:Pm,color_pars_vertex:Im,color_vertex:Dm,common:Lm,defaultnormal_vertex:Nm,displacementmap_pars_vertex:Fm,displacementmap_vertex:Um,emissivemap_fragment:km,emissivemap_pars_fragment:Om,colorspace_fragment:Bm,colorspace_pars_fragment:zm,envmap_fragment:Gm,envmap_common_pars_fragment:Vm,envmap_pars_fragment:Hm,envmap_pars_vertex:Wm,envmap_physical_pars_fragment:tg,envmap_vertex:Xm,fog_vertex:qm,fog_pars_vertex:Km,fog_fragment:Ym,fog_pars_fragment:Zm,gradientmap_pars_fragment:$m,lightmap_pars_fragment:Jm,lights_lambert_fragment:jm,lights_lambert_pars_fragment:Qm,lights_pars_begin:eg,lights_toon_fragment:ng,lights_toon_pars_fragment:ig,lights_phong_fragment:sg,lights_phong_pars_fragment:rg,lights_physical_fragment:ag,lights_physical_pars_fragment:og,lights_fragment_begin:lg,lights_fragment_maps:cg,lights_fragment_end:hg,lightprobes_pars_fragment:ug,logdepthbuf_fragment:dg,logdepthbuf_pars_fragment:fg,logdepthbuf_pars_vertex:pg,logdepthbuf_vertex:mg,map_fragment:gg,map_pars_fragment:_g,map_particle_fragment:bg,map_particle_pars_fragment:xg,metalnessmap_fragment:vg,metalnessmap_pars_fragment:yg,morphinstance_vertex:wg,morphcolor_vertex:Sg,morphnormal_vertex:Mg,morphtarget_pars_vertex:Ag,morphtarget_vertex:Tg,normal_fragment_begin:Eg,normal_fragment_maps:Rg,normal_pars_fragment:Cg,normal_pars_vertex:Pg,normal_vertex:Ig,normalmap_pars_fragment:Dg,clearcoat_normal_fragment_begin:Lg,clearcoat_normal_fragment_maps:Ng,clearcoat_pars_fragment:Fg,iridescence_pars_fragment:Ug,opaque_fragment:kg,packing:Og,premultiplied_alpha_fragment:Bg,project_vertex:zg,dithering_fragment:Gg,dithering_pars_fragment:Vg,roughnessmap_fragment:Hg,roughnessmap_pars_fragment:Wg,shadowmap_pars_fragment:Xg,shadowmap_pars_vertex:qg,shadowmap_vertex:Kg,shadowmask_pars_fragment:Yg,skinbase_vertex:Zg,skinning_pars_vertex:$g,skinning_vertex:Jg,skinnormal_vertex:jg,specularmap_fragment:Qg,specularmap_pars_fragment:e_,tonemapping_fragment:t_,tonemapping_pars_fragment:n_,transmission_fragment:i_,transmission_pars_fragment:s_,uv_pars_fragment:r_,uv_pars_vertex:a_,uv_vertex:o_,worldpos_vertex:l_,background_vert:c_,background_frag:h_,backgroundCube_vert:u_,backgroundCube_frag:d_,cube_vert:f_,cube_frag:p_,depth_vert:m_,depth_frag:g_,distance_vert:__,distance_frag:b_,equirect_vert:x_,equirect_frag:v_,linedashed_vert:y_,linedashed_frag:w_,meshbasic_vert:S_,meshbasic_frag:M_,meshlambert_vert:A_,meshlambert_frag:T_,meshmatcap_vert:E_,meshmatcap_frag:R_,meshnormal_vert:C_,meshnormal_frag:P_,meshphong_vert:I_,meshphong_frag:D_,meshphysical_vert:L_,meshphysical_frag:N_,meshtoon_vert:F_,meshtoon_frag:U_,points_vert:k_,points_frag:O_,shadow_vert:B_,shadow_frag:z_,sprite_vert:G_,sprite_frag:V_},ge={common:{diffuse:{value:new Xe(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new ke},alphaMap:{value:null},alphaMapTransform:{value:new ke},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new ke}},envmap:{envMap:{value:null},envMapRotation:{value:new ke},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new ke}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new ke}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new ke},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new ke},normalScale:{value:new je(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new ke},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new ke}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new ke}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new ke}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Xe(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Xe(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new ke},alphaTest:{value:0},uvTransform:{value:new ke}},sprite:{diffuse:{value:new Xe(16777215)},opacity:{value:1},center:{value:new je(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new ke},alphaMap:{value:null},alphaMapTransform:{value:new ke},alphaTest:{value:0}}},Gn={basic:{uniforms:qt([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.fog]),vertexShader:qe.meshbasic_vert,fragmentShader:qe.meshbasic_frag},lambert:{uniforms:qt([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,ge.lights,{emissive:{value:new Xe(0)},envMapIntensity:{value:1}}]),vertexShader:qe.meshlambert_vert,fragmentShader:qe.meshlambert_frag},phong:{uniforms:qt([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,ge.lights,{emissive:{value:new Xe(0)},specular:{value:new Xe(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:qe.meshphong_vert,fragmentShader:qe.meshphong_frag},standard:{uniforms:qt([ge.common,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.roughnessmap,ge.metalnessmap,ge.fog,ge.lights,{emissive:{value:new Xe(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:qe.meshphysical_vert,fragmentShader:qe.meshphysical_frag},toon:{uniforms:qt([ge.common,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.gradientmap,ge.fog,ge.lights,{emissive:{value:new Xe(0)}}]),vertexShader:qe.meshtoon_vert,fragmentShader:qe.meshtoon_frag},matcap:{uniforms:qt([ge.common,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,{matcap:{value:null}}]),vertexShader:qe.meshmatcap_vert,fragmentShader:qe.meshmatcap_frag},points:{uniforms:qt([ge.points,ge.fog]),vertexShader:qe.points_vert,fragmentShader:qe.points_frag},dashed:{uniforms:qt([ge.common,ge.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:qe.linedashed_vert,fragmentShader:qe.linedashed_frag},depth:{uniforms:qt([ge.common,ge.displacementmap]),vertexShader:qe.depth_vert,fragmentShader:qe.depth_frag},normal:{uniforms:qt([ge.common,ge.bumpmap,ge.normalmap,ge.displacementmap,{opacity:{value:1}}]),vertexShader:qe.meshnormal_vert,fragmentShader:qe.meshnormal_frag},sprite:{uniforms:qt([ge.sprite,ge.fog]),vertexShader:qe.sprite_vert,fragmentShader:qe.sprite_frag},background:{uniforms:{uvTransform:{value:new ke},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:qe.background_vert,fragmentShader:qe.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new ke}},vertexShader:qe.backgroundCube_vert,fragmentShader:qe.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:qe.cube_vert,fragmentShader:qe.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:qe.equirect_vert,fragmentShader:qe.equirect_frag},distance:{uniforms:qt([ge.common,ge.displacementmap,{referencePosition:{value:new F},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:qe.distance_vert,fragmentShader:qe.distance_frag},shadow:{uniforms:qt([ge.lights,ge.fog,{color:{value:new Xe(0)},opacity:{value:1}}]),vertexShader:qe.shadow_vert,fragmentShader:qe.shadow_frag}};Gn.physical={uniforms:qt([Gn.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new ke},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new ke},clearcoatNormalScale:{value:new je(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new ke},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new ke},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new ke},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new ke},sheen:{value:0},sheenColor:{value:new Xe(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new ke},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new ke},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new ke},transmissionSamplerSize:{value:new je},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new ke},attenuationDistance:{value:0},attenuationColor:{value:new Xe(0)},specularColor:{value:new Xe(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new ke},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new ke},anisotropyVector:{value:new je},anisotropyMap:{value:null},anisotropyMapTransform:{value:new ke}}]),vertexShader:qe.meshphysical_vert,fragmentShader:qe.meshphysical_frag};var ko={r:0,b:0,g:0},H_=new ct,wd=new ke;wd.set(-1,0,0,0,1,0,0,0,1);function W_(n,e,t,i,s,r){let a=new Xe(0),o=s===!0?0:1,c,l,u=null,d=0,h=null;function f(v){let S=v.isScene===!0?v.background:null;if(S&&S.isTexture){let w=v.backgroundBlurriness>0;S=e.get(S,w)}return S}function g(v){let S=!1,w=f(v);w===null?m(a,o):w&&w.isColor&&(m(w,1),S=!0);let T=n.xr.getEnvironmentBlendMode();T==="additive"?t.buffers.color.setClear(0,0,0,1,r):T==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(n.autoClear||S)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function x(v,S){let w=f(S);w&&w.isCubeTexture?(l===void 0&&(l=new Et(new Ss(1,1,1),new On({name:"BackgroundCubeMaterial",uniforms:$i(Gn.backgroundCube.uniforms),vertexShader:Gn.backgroundCube.vertexShader,fragmentShader:Gn.backgroundCube.fragmentShader,side:Qt,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),l.geometry.deleteAttribute("uv"),l.onBeforeRender=function(T,A,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(l.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(l)),l.material.uniforms.envMap.value=w,l.material.uniforms.backgroundBlurriness.value=S.backgroundBlurriness,l.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,l.material.uniforms.backgroundRotation.value.setFromMatrix4(H_.makeRotationFromEuler(S.backgroundRotation)).transpose(),w.isRenderTargetTexture===!1&&l.material.uniforms.backgroundRotation.value.premultiply(wd),l.material.toneMapped=Je.getTransfer(w.colorSpace)!==it,(u!==w||d!==w.version||h!==n.toneMapping)&&(l.material.needsUpdate=!0,u=w,d=w.version,h=n.toneMapping),l.layers.enableAll(),v.unshift(l,l.geometry,l.material,0,0,null)):w&&w.isTexture&&(c===void 0&&(c=new Et(new Xi(2,2),new On({name:"BackgroundMaterial",uniforms:$i(Gn.background.uniforms),vertexShader:Gn.background.vertexShader,fragmentShader:Gn.background.fragmentShader,side:Ti,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(c)),c.material.uniforms.t2D.value=w,c.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,c.material.toneMapped=Je.getTransfer(w.colorSpace)!==it,w.matrixAutoUpdate===!0&&w.updateMatrix(),c.material.uniforms.uvTransform.value.copy(w.matrix),(u!==w||d!==w.version||h!==n.toneMapping)&&(c.material.needsUpdate=!0,u=w,d=w.version,h=n.toneMapping),c.layers.enableAll(),v.unshift(c,c.geometry,c.material,0,0,null))}function m(v,S){v.getRGB(ko,fc(n)),t.buffers.color.setClear(ko.r,ko.g,ko.b,S,r)}function p(){l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0),c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0)}return{getClearColor:function(){return a},setClearColor:function(v,S=1){a.set(v),o=S,m(a,o)},getClearAlpha:function(){return o},setClearAlpha:function(v){o=v,m(a,o)},render:g,addToRenderList:x,dispose:p}}function X_(n,e){let t=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=h(null),r=s,a=!1;function o(N,B,W,P,H){let K=!1,V=d(N,P,W,B);r!==V&&(r=V,l(r.object)),K=f(N,P,W,H),K&&g(N,P,W,H),H!==null&&e.update(H,n.ELEMENT_ARRAY_BUFFER),(K||a)&&(a=!1,w(N,B,W,P),H!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,e.get(H).buffer))}function c(){return n.createVertexArray()}function l(N){return n.bindVertexArray(N)}function u(N){return n.deleteVertexArray(N)}function d(N,B,W,P){let H=P.wireframe===!0,K=i[B.id];K===void 0&&(K={},i[B.id]=K);let V=N.isInstancedMesh===!0?N.id:0,ie=K[V];ie===void 0&&(ie={},K[V]=ie);let q=ie[W.id];q===void 0&&(q={},ie[W.id]=q);let Q=q[H];return Q===void 0&&(Q=h(c()),q[H]=Q),Q}function h(N){let B=[],W=[],P=[];for(let H=0;H<t;H++)B[H]=0,W[H]=0,P[H]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:B,enabledAttributes:W,attributeDivisors:P,object:N,attributes:{},index:null}}function f(N,B,W,P){let H=r.attributes,K=B.attributes,V=0,ie=W.getAttributes();for(let q in ie)if(ie[q].location>=0){let ee=H[q],Ae=K[q];if(Ae===void 0&&(q==="instanceMatrix"&&N.instanceMatrix&&(Ae=N.instanceMatrix),q==="instanceColor"&&N.instanceColor&&(Ae=N.instanceColor)),ee===void 0||ee.attribute!==Ae||Ae&&ee.data!==Ae.data)return!0;V++}return r.attributesNum!==V||r.index!==P}function g(N,B,W,P){let H={},K=B.attributes,V=0,ie=W.getAttributes();for(let q in ie)if(ie[q].location>=0){let ee=K[q];ee===void 0&&(q==="instanceMatrix"&&N.instanceMatrix&&(ee=N.instanceMatrix),q==="instanceColor"&&N.instanceColor&&(ee=N.instanceColor));let Ae={};Ae.attribute=ee,ee&&ee.data&&(Ae.data=ee.data),H[q]=Ae,V++}r.attributes=H,r.attributesNum=V,r.index=P}function x(){let N=r.newAttributes;for(let B=0,W=N.length;B<W;B++)N[B]=0}function m(N){p(N,0)}function p(N,B){let W=r.newAttributes,P=r.enabledAttributes,H=r.attributeDivisors;W[N]=1,P[N]===0&&(n.enableVertexAttribArray(N),P[N]=1),H[N]!==B&&(n.vertexAttribDivisor(N,B),H[N]=B)}function v(){let N=r.newAttributes,B=r.enabledAttributes;for(let W=0,P=B.length;W<P;W++)B[W]!==N[W]&&(n.disableVertexAttribArray(W),B[W]=0)}function S(N,B,W,P,H,K,V){V===!0?n.vertexAttribIPointer(N,B,W,H,K):n.vertexAttribPointer(N,B,W,P,H,K)}function w(N,B,W,P){x();let H=P.attributes,K=W.getAttributes(),V=B.defaultAttributeValues;for(let ie in K){let q=K[ie];if(q.location>=0){let Q=H[ie];if(Q===void 0&&(ie==="instanceMatrix"&&N.instanceMatrix&&(Q=N.instanceMatrix),ie==="instanceColor"&&N.instanceColor&&(Q=N.instanceColor)),Q!==void 0){let ee=Q.normalized,Ae=Q.itemSize,Be=e.get(Q);if(Be===void 0)continue;let $=Be.buffer,_e=Be.type,ye=Be.bytesPerElement,Ie=_e===n.INT||_e===n.UNSIGNED_INT||Q.gpuType===Qa;if(Q.isInterleavedBufferAttribute){let be=Q.data,Ve=be.isInterleavedBuffer===!0?be.stride:be.itemSize,Mt=Q.offset;if(be.isInstancedInterleavedBuffer||be.isInstancedBufferAttribute){for(let Fe=0;Fe<q.locationSize;Fe++)p(q.location+Fe,be.meshPerAttribute);N.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=be.meshPerAttribute*be.count)}else for(let Fe=0;Fe<q.locationSize;Fe++)m(q.location+Fe);n.bindBuffer(n.ARRAY_BUFFER,$);for(let Fe=0;Fe<q.locationSize;Fe++)S(q.location+Fe,Ae/q.locationSize,_e,ee,Ve*ye,(Mt+Ae/q.locationSize*Fe)*ye,Ie)}else{if(Q.isInstancedBufferAttribute){for(let be=0;be<q.locationSize;be++)p(q.location+be,Q.meshPerAttribute);N.isInstancedMesh!==!0&&P._maxInstanceCount===void 0&&(P._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let be=0;be<q.locationSize;be++)m(q.location+be);n.bindBuffer(n.ARRAY_BUFFER,$);for(let be=0;be<q.locationSize;be++)S(q.location+be,Ae/q.locationSize,_e,ee,Ae*ye,Ae/q.locationSize*be*ye,Ie)}}else if(V!==void 0){let ee=V[ie];if(ee!==void 0)switch(ee.length){case 2:n.vertexAttrib2fv(q.location,ee);break;case 3:n.vertexAttrib3fv(q.location,ee);break;case 4:n.vertexAttrib4fv(q.location,ee);break;default:n.vertexAttrib1fv(q.location,ee)}}}}v()}function T(){U();for(let N in i){let B=i[N];for(let W in B){let P=B[W];for(let H in P){let K=P[H];for(let V in K)u(K[V].object),delete K[V];delete P[H]}}delete i[N]}}function A(N){if(i[N.id]===void 0)return;let B=i[N.id];for(let W in B){let P=B[W];for(let H in P){let K=P[H];for(let V in K)u(K[V].object),delete K[V];delete P[H]}}delete i[N.id]}function _(N){for(let B in i){let W=i[B];for(let P in W){let H=W[P];if(H[N.id]===void 0)continue;let K=H[N.id];for(let V in K)u(K[V].object),delete K[V];delete H[N.id]}}}function M(N){for(let B in i){let W=i[B],P=N.isInstancedMesh===!0?N.id:0,H=W[P];if(H!==void 0){for(let K in H){let V=H[K];for(let ie in V)u(V[ie].object),delete V[ie];delete H[K]}delete W[P],Object.keys(W).length===0&&delete i[B]}}}function U(){D(),a=!0,r!==s&&(r=s,l(r.object))}function D(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:o,reset:U,resetDefaultState:D,dispose:T,releaseStatesOfGeometry:A,releaseStatesOfObject:M,releaseStatesOfProgram:_,initAttributes:x,enableAttribute:m,disableUnusedAttributes:v}}function q_(n,e,t){let i;function s(c){i=c}function r(c,l){n.drawArrays(i,c,l),t.update(l,i,1)}function a(c,l,u){u!==0&&(n.drawArraysInstanced(i,c,l,u),t.update(l,i,u))}function o(c,l,u){if(u===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,c,0,l,0,u);let h=0;for(let f=0;f<u;f++)h+=l[f];t.update(h,i,1)}this.setMode=s,this.render=r,this.renderInstances=a,this.renderMultiDraw=o}function K_(n,e,t,i){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let _=e.get("EXT_texture_filter_anisotropic");s=n.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function a(_){return!(_!==Rn&&i.convert(_)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function o(_){let M=_===En&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(_!==rn&&_!==Tn&&!M&&i.convert(_)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function c(_){if(_==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let l=t.precision!==void 0?t.precision:"highp",u=c(l);u!==l&&(Le("WebGLRenderer:",l,"not supported, using",u,"instead."),l=u);let d=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),h=t.logarithmicDepthBuffer===!0&&d===!1;t.reversedDepthBuffer===!0&&d===!1&&Le("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&d===!0&&Le("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),g=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=n.getParameter(n.MAX_TEXTURE_SIZE),m=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),p=n.getParameter(n.MAX_VERTEX_ATTRIBS),v=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),S=n.getParameter(n.MAX_VARYING_VECTORS),w=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),T=n.getParameter(n.MAX_SAMPLES),A=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:c,textureFormatReadable:a,textureTypeReadable:o,precision:l,logarithmicDepthBuffer:h,reversedDepthBuffer:d,maxTextures:f,maxVertexTextures:g,maxTextureSize:x,maxCubemapSize:m,maxAttributes:p,maxVertexUniforms:v,maxVaryings:S,maxFragmentUniforms:w,maxSamples:T,samples:A}}function Y_(n){let e=this,t=null,i=0,s=!1,r=!1,a=new Mn,o=new ke,c={value:null,needsUpdate:!1};this.uniform=c,this.numPlanes=0,this.numIntersection=0,this.init=function(d,h){let f=d.length!==0||h||i!==0||s;return s=h,i=d.length,f},this.beginShadows=function(){r=!0,u(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(d,h){t=u(d,h,0)},this.setState=function(d,h,f){let g=d.clippingPlanes,x=d.clipIntersection,m=d.clipShadows,p=n.get(d);if(!s||g===null||g.length===0||r&&!m)r?u(null):l();else{let v=r?0:i,S=v*4,w=p.clippingState||null;c.value=w,w=u(g,h,S,f);for(let T=0;T!==S;++T)w[T]=t[T];p.clippingState=w,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=v}};function l(){c.value!==t&&(c.value=t,c.needsUpdate=i>0),e.numPlanes=i,e.numIntersection=0}function u(d,h,f,g){let x=d!==null?d.length:0,m=null;if(x!==0){if(m=c.value,g!==!0||m===null){let p=f+x*4,v=h.matrixWorldInverse;o.getNormalMatrix(v),(m===null||m.length<p)&&(m=new Float32Array(p));for(let S=0,w=f;S!==x;++S,w+=4)a.copy(d[S]).applyMatrix4(v,o),a.normal.toArray(m,w),m[w+3]=a.constant}c.value=m,c.needsUpdate=!0}return e.numPlanes=x,e.numIntersection=0,m}}var Er=class extends hn{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let i={width:e,height:e,depth:1},s=[i,i,i,i,i,i];this.texture=new ar(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Ss(5,5,5),r=new On({name:"CubemapFromEquirect",uniforms:$i(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:Qt,blending:qi});r.uniforms.tEquirect.value=t;let a=new Et(s,r),o=t.minFilter;return t.minFilter===ri&&(t.minFilter=Jt),new Ms(1,10,this).update(e,a),t.minFilter=o,a.geometry.dispose(),a.material.dispose(),this}clear(e,t=!0,i=!0,s=!0){let r=e.getRenderTarget();for(let a=0;a<6;a++)e.setRenderTarget(this,a),e.clear(t,i,s);e.setRenderTarget(r)}},ed=256,Z_=3,$_=20,Sd=256,Md=16,J_=3,j_=new F,Q_=new Xe,Bo=class n{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Ms(1,10,null),this._boxMesh=new Et(new Ss(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,i=.1,s=100,r={}){let{size:a=256,position:o=j_}=r,c=this._renderer;this._setSize(a);let l=this._allocateTarget(),u=this._getSourceTarget(!0);t>0&&(u.texture.mipmapsAutoUpdate=!1);let d=c.autoClear,h=c.autoClearColor,f=c.autoClearDepth,g=c.autoClearStencil,x=e.background;c.autoClear=!0,c.autoClearColor=!0,c.autoClearDepth=!0,c.autoClearStencil=!0,x===null&&(e.background=c.getClearColor(Q_));let m=new Ms(i,s,u);return m.position.copy(o),m.update(c,e),c.autoClear=d,c.autoClearColor=h,c.autoClearDepth=f,c.autoClearStencil=g,e.background=x,t>0&&(u.texture.mipmapsAutoUpdate=!0,this._blur(l,t)),this._applyPMREM(l),l}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=id(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=nd(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(ed,Zu(e))}_fromTexture(e,t){e.mapping===Yi||e.mapping===Es?this._setSize(e.image.length===0?ed:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let i=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(i),i}_allocateTarget(){let e=this._cubeSize,t=td(e,!1,!1),i=Math.log2(e)-Z_;for(let s=0;s<=i;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==t||e&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=td(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=e,r.activeMipmapLevel=t;let a=e.width>>t;e.viewport.set(0,0,a,a),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Yi||e.mapping===Es?(this._cubemapMaterial===null&&(this._cubemapMaterial=id()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=nd()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=e0(),this._integrationMaterial=t0());let t=this._cubeSize,i=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Md);for(let a=0;a<=i;a++){let o=n.lodToRoughness(a,i);if(a>i-J_)r.roughness.value=o,this._renderCube(e,a,this._integrationMaterial);else{let c=o>0?Math.log2(t)+.5*Math.log2(6/(Sd*Math.pow(o,4)))+.5:0;s.roughness.value=o,s.lodBias.value=c,this._renderCube(e,a,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=n0());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,i),s.envMap.value=e.texture,this._renderCube(r,0,i)}};function td(n,e,t){return new Er(n,{minFilter:ri,generateMipmaps:e,type:En,colorSpace:$s,depthBuffer:t})}function Rr(n,e,t){return new On({name:n,uniforms:e,vertexShader:qe.cube_vert,fragmentShader:t,side:Qt,blending:qi,depthTest:!1,depthWrite:!1})}function e0(){return Rr("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Sd}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function t0(){return Rr("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Md}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function n0(){return Rr("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${$_}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function nd(){return Rr("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function id(){return Rr("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function i0(n){let e=new WeakMap,t=new WeakMap,i=null;function s(h,f=!1){return h==null?null:f?a(h):r(h)}function r(h){if(h&&h.isTexture){let f=h.mapping;if(f===$a||f===Ja)if(e.has(h)){let g=e.get(h).texture;return o(g,h.mapping)}else{let g=h.image;if(g&&g.height>0){let x=new Er(g.height);return x.fromEquirectangularTexture(n,h),e.set(h,x),h.addEventListener("dispose",l),o(x.texture,h.mapping)}else return null}}return h}function a(h){if(h&&h.isTexture&&h.isPMREMTexture!==!0){let f=h.mapping,g=f===$a||f===Ja,x=f===Yi||f===Es;if(g||x){let m=t.get(h),p=m!==void 0?m.texture.pmremVersion:0;if(h.isRenderTargetTexture&&h.pmremVersion!==p)return i===null&&(i=new Bo(n)),m=g?i.fromEquirectangular(h,m):i.fromCubemap(h,m),m.texture.pmremVersion=h.pmremVersion,t.set(h,m),m.texture;if(m!==void 0)return m.texture;{let v=h.image;return g&&v&&v.height>0||x&&v&&c(v)?(i===null&&(i=new Bo(n)),m=g?i.fromEquirectangular(h):i.fromCubemap(h),m.texture.pmremVersion=h.pmremVersion,t.set(h,m),h.addEventListener("dispose",u),m.texture):null}}}return h}function o(h,f){return f===$a?h.mapping=Yi:f===Ja&&(h.mapping=Es),h}function c(h){let f=0,g=6;for(let x=0;x<g;x++)h[x]!==void 0&&f++;return f===g}function l(h){let f=h.target;f.removeEventListener("dispose",l);let g=e.get(f);g!==void 0&&(e.delete(f),g.dispose())}function u(h){let f=h.target;f.removeEventListener("dispose",u);let g=t.get(f);g!==void 0&&(t.delete(f),g.dispose())}function d(){e=new WeakMap,t=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:d}}function s0(n){let e={};function t(i){if(e[i]!==void 0)return e[i];let s=n.getExtension(i);return e[i]=s,s}return{has:function(i){return t(i)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(i){let s=t(i);return s===null&&Ys("WebGLRenderer: "+i+" extension not supported."),s}}}function r0(n,e,t,i){let s={},r=new WeakMap,a=new FinalizationRegistry(g=>delete s[g]);function o(g){c(g.target)}function c(g){g.index!==null&&e.remove(g.index);for(let m in g.attributes)e.remove(g.attributes[m]);g.removeEventListener("dispose",o),delete s[g.id],a.unregister(g);let x=r.get(g);x&&(e.remove(x),r.delete(g)),i.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,t.memory.geometries--}function l(g,x){return s[x.id]!==void 0||(x.addEventListener("dispose",o),s[x.id]=new WeakRef(x),a.register(x,x.id,x),t.memory.geometries++),x}function u(g){let x=g.attributes;for(let m in x)e.update(x[m],n.ARRAY_BUFFER)}function d(g){let x=g.index,m=g.attributes.position,p=0;if(m===void 0)return;let v=x!==null?x.array.length:m.array.length/3-1,S=m.count>=65535?ir:nr,w=new S(Math.ceil(v/3)*6,1),T=w.array;if(x!==null){let _=x.array;p=x.version;for(let M=0,U=0;M<v;M+=3){let D=_[M+0],N=_[M+1],B=_[M+2];T[U++]=D,T[U++]=N,T[U++]=N,T[U++]=B,T[U++]=B,T[U++]=D}}else{p=m.version;for(let _=0,M=0;_<v;_+=3){let U=_+0,D=_+1,N=_+2;T[M++]=U,T[M++]=D,T[M++]=D,T[M++]=N,T[M++]=N,T[M++]=U}}w.version=p;let A=r.get(g);A&&e.remove(A),r.set(g,w)}function h(g){let x=r.get(g);if(x){let m=g.index;m!==null&&x.version<m.version&&d(g)}else d(g);return r.get(g)}function f(){for(let g in s){let x=s[g].deref();x!==void 0&&c(x)}}return{get:l,update:u,getWireframeAttribute:h,dispose:f}}function a0(n,e,t){let i;function s(d){i=d}let r,a;function o(d){r=d.type,a=d.bytesPerElement}function c(d,h){n.drawElements(i,h,r,d*a),t.update(h,i,1)}function l(d,h,f){f!==0&&(n.drawElementsInstanced(i,h,r,d*a,f),t.update(h,i,f))}function u(d,h,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,h,0,r,d,0,f);let x=0;for(let m=0;m<f;m++)x+=h[m];t.update(x,i,1)}this.setMode=s,this.setIndex=o,this.render=c,this.renderInstances=l,this.renderMultiDraw=u}function o0(n){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,a,o){switch(t.calls++,a){case n.TRIANGLES:t.triangles+=o*(r/3);break;case n.LINES:t.lines+=o*(r/2);break;case n.LINE_STRIP:t.lines+=o*(r-1);break;case n.LINE_LOOP:t.lines+=o*r;break;case n.POINTS:t.points+=o*r;break;default:Ue("WebGLInfo: Unknown draw mode:",a);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:i}}function l0(n,e,t){let i=new WeakMap,s=new xt;function r(a,o,c){let l=a.morphTargetInfluences,u=o.morphAttributes.position||o.morphAttributes.normal||o.morphAttributes.color,d=u!==void 0?u.length:0,h=i.get(o);if(h===void 0||h.count!==d){let U=function(){_.dispose(),i.delete(o),o.removeEventListener("dispose",U)};h!==void 0&&h.texture.dispose();let f=o.morphAttributes.position!==void 0,g=o.morphAttributes.normal!==void 0,x=o.morphAttributes.color!==void 0,m=o.morphAttributes.position||[],p=o.morphAttributes.normal||[],v=o.morphAttributes.color||[],S=0;f===!0&&(S=1),g===!0&&(S=2),x===!0&&(S=3);let w=o.attributes.position.count*S,T=1;w>e.maxTextureSize&&(T=Math.ceil(w/e.maxTextureSize),w=e.maxTextureSize);let A=new Float32Array(w*T*4*d),_=new Qs(A,w,T,d);_.type=Tn,_.needsUpdate=!0;let M=S*4;for(let D=0;D<d;D++){let N=m[D],B=p[D],W=v[D],P=w*T*4*D;for(let H=0;H<N.count;H++){let K=H*M;f===!0&&(s.fromBufferAttribute(N,H),A[P+K+0]=s.x,A[P+K+1]=s.y,A[P+K+2]=s.z,A[P+K+3]=0),g===!0&&(s.fromBufferAttribute(B,H),A[P+K+4]=s.x,A[P+K+5]=s.y,A[P+K+6]=s.z,A[P+K+7]=0),x===!0&&(s.fromBufferAttribute(W,H),A[P+K+8]=s.x,A[P+K+9]=s.y,A[P+K+10]=s.z,A[P+K+11]=W.itemSize===4?s.w:1)}}h={count:d,texture:_,size:new je(w,T)},i.set(o,h),o.addEventListener("dispose",U)}if(a.isInstancedMesh===!0&&a.morphTexture!==null)c.getUniforms().setValue(n,"morphTexture",a.morphTexture,t);else{let f=0;for(let x=0;x<l.length;x++)f+=l[x];let g=o.morphTargetsRelative?1:1-f;c.getUniforms().setValue(n,"morphTargetBaseInfluence",g),c.getUniforms().setValue(n,"morphTargetInfluences",l)}c.getUniforms().setValue(n,"morphTargetsTexture",h.texture,t),c.getUniforms().setValue(n,"morphTargetsTextureSize",h.size)}return{update:r}}function c0(n,e,t,i,s){let r=new WeakMap;function a(l){let u=s.render.frame,d=l.geometry,h=e.get(l,d);if(r.get(h)!==u&&(e.update(h),r.set(h,u)),l.isInstancedMesh&&(l.hasEventListener("dispose",c)===!1&&l.addEventListener("dispose",c),r.get(l)!==u&&(t.update(l.instanceMatrix,n.ARRAY_BUFFER),l.instanceColor!==null&&t.update(l.instanceColor,n.ARRAY_BUFFER),r.set(l,u))),l.isSkinnedMesh){let f=l.skeleton;r.get(f)!==u&&(f.update(),r.set(f,u))}return h}function o(){r=new WeakMap}function c(l){let u=l.target;u.removeEventListener("dispose",c),i.releaseStatesOfObject(u),t.remove(u.instanceMatrix),u.instanceColor!==null&&t.remove(u.instanceColor)}return{update:a,dispose:o}}var h0={[ql]:"LINEAR_TONE_MAPPING",[Kl]:"REINHARD_TONE_MAPPING",[Yl]:"CINEON_TONE_MAPPING",[Zl]:"ACES_FILMIC_TONE_MAPPING",[Jl]:"AGX_TONE_MAPPING",[jl]:"NEUTRAL_TONE_MAPPING",[$l]:"CUSTOM_TONE_MAPPING"};function u0(n,e,t,i,s,r){let a=new hn(e,t,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),o=null,c=null,l=null,u=new nn;u.setAttribute("position",new wt([-1,3,0,-1,-1,0,3,-1,0],3)),u.setAttribute("uv",new wt([0,2,0,0,2,0],2));let d=new Na({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),h=new Et(u,d),f=new pr(-1,1,1,-1,0,1),g=null,x=null,m=!1,p,v=null,S=[],w=!1;this.setSize=function(T,A){a.setSize(T,A),o!==null&&o.setSize(T,A),c!==null&&c.setSize(T,A);for(let _=0;_<S.length;_++){let M=S[_];M.setSize&&M.setSize(T,A)}},this.setEffects=function(T){S=T,w=S.length>0&&S[0].isRenderPass===!0;let A=a.width,_=a.height;S.length>0&&o===null&&(o=new hn(A,_,{type:En,depthBuffer:!1,stencilBuffer:!1}),c=new hn(A,_,{type:En,depthBuffer:!1,stencilBuffer:!1}));let M=s===!0&&S.some(U=>U.needsDepthTexture===!0);M!==(a.depthTexture!==null)&&(M===!0&&l===null&&(l=new ii(A,_),r===!0&&(l.format=ai,l.type=Zi)),a.dispose(),a.depthTexture=M?l:null,a.resolveDepthBuffer=M,a.storeMultisampledDepthBuffer=M);for(let U=0;U<S.length;U++){let D=S[U];D.setSize&&D.setSize(A,_),M&&D.needsDepthTexture===!0&&D.setDepthTexture&&D.setDepthTexture(l)}},this.begin=function(T,A){if(m||T.toneMapping===Bn&&S.length===0)return!1;if(v=A,A!==null){let _=A.width,M=A.height;(a.width!==_||a.height!==M)&&this.setSize(_,M)}return w===!1&&T.setRenderTarget(a),p=T.toneMapping,T.toneMapping=Bn,!0},this.hasRenderPass=function(){return w},this.end=function(T,A){T.toneMapping=p,m=!0;let _=a,M=o;for(let U=0;U<S.length;U++){let D=S[U];D.enabled!==!1&&(D.render(T,M,_,A),D.needsSwap!==!1&&(_=M,M=M===o?c:o))}if(g!==T.outputColorSpace||x!==T.toneMapping){g=T.outputColorSpace,x=T.toneMapping,d.defines={},Je.getTransfer(g)===it&&(d.defines.SRGB_TRANSFER="");let U=h0[x];U&&(d.defines[U]=""),d.needsUpdate=!0}d.uniforms.tDiffuse.value=_.texture,T.setRenderTarget(v),T.render(h,f),v=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){a.dispose(),o!==null&&o.dispose(),c!==null&&c.dispose(),u.dispose(),d.dispose()}}var Ad=new jt,Td=new ii(1,1),Ed=new lr(1),Rd=new Qs,Cd=new Ra,Pd=new ar,sd=[],rd=[],ad=new Float32Array(16),od=new Float32Array(9),ld=new Float32Array(4);function Ps(n,e,t){let i=n[0];if(i<=0||i>0)return n;let s=e*t,r=sd[s];if(r===void 0&&(r=new Float32Array(s),sd[s]=r),e!==0){i.toArray(r,0);for(let a=1,o=0;a!==e;++a)o+=t,n[a].toArray(r,o)}return r}function It(n,e){if(n.length!==e.length)return!1;for(let t=0,i=n.length;t<i;t++)if(n[t]!==e[t])return!1;return!0}function Dt(n,e){for(let t=0,i=e.length;t<i;t++)n[t]=e[t]}function Go(n,e){let t=rd[e];t===void 0&&(t=new Int32Array(e),rd[e]=t);for(let i=0;i!==e;++i)t[i]=n.allocateTextureUnit();return t}function d0(n,e){let t=this.cache;t[0]!==e&&(n.uniform1f(this.addr,e),t[0]=e)}function f0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(It(t,e))return;n.uniform2fv(this.addr,e),Dt(t,e)}}function p0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(n.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(It(t,e))return;n.uniform3fv(this.addr,e),Dt(t,e)}}function m0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(It(t,e))return;n.uniform4fv(this.addr,e),Dt(t,e)}}function g0(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(It(t,e))return;n.uniformMatrix2fv(this.addr,!1,e),Dt(t,e)}else{if(It(t,i))return;ld.set(i),n.uniformMatrix2fv(this.addr,!1,ld),Dt(t,i)}}function _0(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(It(t,e))return;n.uniformMatrix3fv(this.addr,!1,e),Dt(t,e)}else{if(It(t,i))return;od.set(i),n.uniformMatrix3fv(this.addr,!1,od),Dt(t,i)}}function b0(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(It(t,e))return;n.uniformMatrix4fv(this.addr,!1,e),Dt(t,e)}else{if(It(t,i))return;ad.set(i),n.uniformMatrix4fv(this.addr,!1,ad),Dt(t,i)}}function x0(n,e){let t=this.cache;t[0]!==e&&(n.uniform1i(this.addr,e),t[0]=e)}function v0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(It(t,e))return;n.uniform2iv(this.addr,e),Dt(t,e)}}function y0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(It(t,e))return;n.uniform3iv(this.addr,e),Dt(t,e)}}function w0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(It(t,e))return;n.uniform4iv(this.addr,e),Dt(t,e)}}function S0(n,e){let t=this.cache;t[0]!==e&&(n.uniform1ui(this.addr,e),t[0]=e)}function M0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(It(t,e))return;n.uniform2uiv(this.addr,e),Dt(t,e)}}function A0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(It(t,e))return;n.uniform3uiv(this.addr,e),Dt(t,e)}}function T0(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(It(t,e))return;n.uniform4uiv(this.addr,e),Dt(t,e)}}function Vo(n){return n.version===0&&(n.compareFunction=cc,n.needsUpdate=!0),n}function E0(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=Vo(Td):r=Ad,t.setTexture2D(e||r,s)}function R0(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture3D(e||Cd,s)}function C0(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=Vo(Ed):r=Pd,t.setTextureCube(e||r,s)}function P0(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture2DArray(e||Rd,s)}function I0(n){switch(n){case 5126:return d0;case 35664:return f0;case 35665:return p0;case 35666:return m0;case 35674:return g0;case 35675:return _0;case 35676:return b0;case 5124:case 35670:return x0;case 35667:case 35671:return v0;case 35668:case 35672:return y0;case 35669:case 35673:return w0;case 5125:return S0;case 36294:return M0;case 36295:return A0;case 36296:return T0;case 35678:case 36198:case 36298:case 36306:case 35682:return E0;case 35679:case 36299:case 36307:return R0;case 35680:case 36300:case 36308:case 36293:return C0;case 36289:case 36303:case 36311:case 36292:return P0}}function D0(n,e){n.uniform1fv(this.addr,e)}function L0(n,e){let t=Ps(e,this.size,2);n.uniform2fv(this.addr,t)}function N0(n,e){let t=Ps(e,this.size,3);n.uniform3fv(this.addr,t)}function F0(n,e){let t=Ps(e,this.size,4);n.uniform4fv(this.addr,t)}function U0(n,e){let t=Ps(e,this.size,4);n.uniformMatrix2fv(this.addr,!1,t)}function k0(n,e){let t=Ps(e,this.size,9);n.uniformMatrix3fv(this.addr,!1,t)}function O0(n,e){let t=Ps(e,this.size,16);n.uniformMatrix4fv(this.addr,!1,t)}function B0(n,e){n.uniform1iv(this.addr,e)}function z0(n,e){n.uniform2iv(this.addr,e)}function G0(n,e){n.uniform3iv(this.addr,e)}function V0(n,e){n.uniform4iv(this.addr,e)}function H0(n,e){n.uniform1uiv(this.addr,e)}function W0(n,e){n.uniform2uiv(this.addr,e)}function X0(n,e){n.uniform3uiv(this.addr,e)}function q0(n,e){n.uniform4uiv(this.addr,e)}function K0(n,e,t){let i=this.cache,s=e.length,r=Go(t,s);It(i,r)||(n.uniform1iv(this.addr,r),Dt(i,r));let a;this.type===n.SAMPLER_2D_SHADOW?a=Vo(Td):a=Ad;for(let o=0;o!==s;++o)t.setTexture2D(e[o]||a,r[o])}function Y0(n,e,t){let i=this.cache,s=e.length,r=Go(t,s);It(i,r)||(n.uniform1iv(this.addr,r),Dt(i,r));for(let a=0;a!==s;++a)t.setTexture3D(e[a]||Cd,r[a])}function Z0(n,e,t){let i=this.cache,s=e.length,r=Go(t,s);It(i,r)||(n.uniform1iv(this.addr,r),Dt(i,r));let a;this.type===n.SAMPLER_CUBE_SHADOW?a=Vo(Ed):a=Pd;for(let o=0;o!==s;++o)t.setTextureCube(e[o]||a,r[o])}function $0(n,e,t){let i=this.cache,s=e.length,r=Go(t,s);It(i,r)||(n.uniform1iv(this.addr,r),Dt(i,r));for(let a=0;a!==s;++a)t.setTexture2DArray(e[a]||Rd,r[a])}function J0(n){switch(n){case 5126:return D0;case 35664:return L0;case 35665:return N0;case 35666:return F0;case 35674:return U0;case 35675:return k0;case 35676:return O0;case 5124:case 35670:return B0;case 35667:case 35671:return z0;case 35668:case 35672:return G0;case 35669:case 35673:return V0;case 5125:return H0;case 36294:return W0;case 36295:return X0;case 36296:return q0;case 35678:case 36198:case 36298:case 36306:case 35682:return K0;case 35679:case 36299:case 36307:return Y0;case 35680:case 36300:case 36308:case 36293:return Z0;case 36289:case 36303:case 36311:case 36292:return $0}}var xc=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.setValue=I0(t.type)}},vc=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=J0(t.type)}},yc=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,i){let s=this.seq;for(let r=0,a=s.length;r!==a;++r){let o=s[r];o.setValue(e,t[o.id],i)}}},_c=/(\w+)(\])?(\[|\.)?/g;function cd(n,e){n.seq.push(e),n.map[e.id]=e}function j0(n,e,t){let i=n.name,s=i.length;for(_c.lastIndex=0;;){let r=_c.exec(i),a=_c.lastIndex,o=r[1],c=r[2]==="]",l=r[3];if(c&&(o=o|0),l===void 0||l==="["&&a+2===s){cd(t,l===void 0?new xc(o,n,e):new vc(o,n,e));break}else{let d=t.map[o];d===void 0&&(d=new yc(o),cd(t,d)),t=d}}}var Cs=class{constructor(e,t){this.seq=[],this.map={};let i=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let a=0;a<i;++a){let o=e.getActiveUniform(t,a),c=e.getUniformLocation(t,o.name);j0(o,c,this)}let s=[],r=[];for(let a of this.seq)a.type===e.SAMPLER_2D_SHADOW||a.type===e.SAMPLER_CUBE_SHADOW||a.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(a):r.push(a);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,i,s){let r=this.map[t];r!==void 0&&r.setValue(e,i,s)}setOptional(e,t,i){let s=t[i];s!==void 0&&this.setValue(e,i,s)}static upload(e,t,i,s){for(let r=0,a=t.length;r!==a;++r){let o=t[r],c=i[o.id];c.needsUpdate!==!1&&o.setValue(e,c.value,s)}}static seqWithValue(e,t){let i=[];for(let s=0,r=e.length;s!==r;++s){let a=e[s];a.id in t&&i.push(a)}return i}};function hd(n,e,t){let i=n.createShader(e);return n.shaderSource(i,t),n.compileShader(i),i}var Q0=37297,eb=0;function tb(n,e){let t=n.split(`
`),i=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let a=s;a<r;a++){let o=a+1;i.push(`${o===e?">":" "} ${o}: ${t[a]}`)}return i.join(`
`)}var ud=new ke;function nb(n){Je._getMatrix(ud,Je.workingColorSpace,n);let e=`mat3( ${ud.elements.map(t=>t.toFixed(4))} )`;switch(Je.getTransfer(n)){case Js:return[e,"LinearTransferOETF"];case it:return[e,"sRGBTransferOETF"];default:return Le("WebGLProgram: Unsupported color space: ",n),[e,"LinearTransferOETF"]}}function dd(n,e,t){let i=n.getShaderParameter(e,n.COMPILE_STATUS),r=(n.getShaderInfoLog(e)||"").trim();if(i&&r==="")return"";let a=/ERROR: 0:(\d+)/.exec(r);if(a){let o=parseInt(a[1]);return t.toUpperCase()+`

`+r+`

`+tb(n.getShaderSource(e),o)}else return r}function ib(n,e){let t=nb(e);return[`vec4 ${n}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var sb={[ql]:"Linear",[Kl]:"Reinhard",[Yl]:"Cineon",[Zl]:"ACESFilmic",[Jl]:"AgX",[jl]:"Neutral",[$l]:"Custom"};function rb(n,e){let t=sb[e];return t===void 0?(Le("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Oo=new F;function ab(){Je.getLuminanceCoefficients(Oo);let n=Oo.x.toFixed(4),e=Oo.y.toFixed(4),t=Oo.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function ob(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Tr).join(`
`)}function lb(n){let e=[];for(let t in n){let i=n[t];i!==!1&&e.push("#define "+t+" "+i)}return e.join(`
`)}function cb(n,e){let t={},i=n.getProgramParameter(e,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(e,s),a=r.name,o=1;r.type===n.FLOAT_MAT2&&(o=2),r.type===n.FLOAT_MAT3&&(o=3),r.type===n.FLOAT_MAT4&&(o=4),t[a]={type:r.type,location:n.getAttribLocation(e,a),locationSize:o}}return t}function Tr(n){return n!==""}function fd(n,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function pd(n,e){return n.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var hb=/^[ \t]*#include +<([\w\d./]+)>/gm;function wc(n){return n.replace(hb,ub)}function ub(n,e){let t=qe[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return wc(t)}var db=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function md(n){return n.replace(db,fb)}function fb(n,e,t,i){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function gd(n){let e=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?e+=`
#define HIGH_PRECISION`:n.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var pb={[gr]:"SHADOWMAP_TYPE_PCF",[As]:"SHADOWMAP_TYPE_VSM"};function mb(n){return pb[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var gb={[Es]:"ENVMAP_MODE_REFRACTION"};function _b(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":gb[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var bb={[Za]:"ENVMAP_BLENDING_MULTIPLY",[Lu]:"ENVMAP_BLENDING_MIX",[Nu]:"ENVMAP_BLENDING_ADD"};function xb(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":bb[n.combine]||"ENVMAP_BLENDING_NONE"}function vb(n,e,t,i){let s=n.getContext(),r=t.defines,a=t.vertexShader,o=t.fragmentShader,c=mb(t),l=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",u=_b(t),d=xb(t),h=ob(t),f=lb(r),g=s.createProgram(),x,m,p=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(x=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Tr).join(`
`),x.length>0&&(x+=`
`),m=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Tr).join(`
`),m.length>0&&(m+=`
`)):(x=[gd(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+u:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+c:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Tr).join(`
`),m=[gd(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+l:"",t.envMap?"#define "+u:"",t.envMap?"#define "+d:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+c:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Bn?"#define TONE_MAPPING":"",t.toneMapping!==Bn?qe.tonemapping_pars_fragment:"",t.toneMapping!==Bn?rb("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",qe.colorspace_pars_fragment,ib("linearToOutputTexel",t.outputColorSpace),ab(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Tr).join(`
`)),a=wc(a),a=fd(a,t),a=pd(a,t),o=wc(o),o=fd(o,t),o=pd(o,t),a=md(a),o=md(o),t.isRawShaderMaterial!==!0&&(p=`#version 300 es
`,x=[h,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,m=["#define varying in",t.glslVersion===hc?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===hc?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let v=p+x+a,S=p+m+o,w=hd(s,s.VERTEX_SHADER,v),T=hd(s,s.FRAGMENT_SHADER,S);s.attachShader(g,w),s.attachShader(g,T),t.index0AttributeName!==void 0?s.bindAttribLocation(g,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function A(D){if(n.debug.checkShaderErrors){let N=s.getProgramInfoLog(g)||"",B=s.getShaderInfoLog(w)||"",W=s.getShaderInfoLog(T)||"",P=N.trim(),H=B.trim(),K=W.trim(),V=!0,ie=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(V=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,g,w,T);else{let q=dd(s,w,"vertex"),Q=dd(s,T,"fragment");Ue("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+D.name+`
Material Type: `+D.type+`

Program Info Log: `+P+`
`+q+`
`+Q)}else P!==""?Le("WebGLProgram: Program Info Log:",P):(H===""||K==="")&&(ie=!1);ie&&(D.diagnostics={runnable:V,programLog:P,vertexShader:{log:H,prefix:x},fragmentShader:{log:K,prefix:m}})}s.deleteShader(w),s.deleteShader(T),_=new Cs(s,g),M=cb(s,g)}let _;this.getUniforms=function(){return _===void 0&&A(this),_};let M;this.getAttributes=function(){return M===void 0&&A(this),M};let U=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return U===!1&&(U=s.getProgramParameter(g,Q0)),U},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=eb++,this.cacheKey=e,this.usedTimes=1,this.program=g,this.vertexShader=w,this.fragmentShader=T,this}var yb=0,Sc=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,i){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let i of t)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,i=t.get(e);return i===void 0&&(i=new Set,t.set(e,i)),i}_getShaderStage(e){let t=this.shaderCache,i=t.get(e);return i===void 0&&(i=new Mc(e),t.set(e,i)),i}},Mc=class{constructor(e){this.id=yb++,this.code=e,this.usedTimes=0}};function wb(n){return n===Ei||n===wr||n===Sr}function Sb(n,e,t,i,s,r){let a=new er,o=new Sc,c=new Set,l=[],u=new Map,d=i.logarithmicDepthBuffer,h={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(_){return c.add(_),_===0?"uv":`uv${_}`}function g(_,M,U,D,N,B){let W=D.fog,P=N.geometry,H=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?D.environment:null,K=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,V=e.get(_.envMap||H,K),ie=h[_.type],q=i.precision;_.precision!==null&&(q=i.getMaxPrecision(_.precision),q!==_.precision&&Le("WebGLProgram.getParameters:",_.precision,"not supported, using",q,"instead."));let Q=P.morphAttributes.position||P.morphAttributes.normal||P.morphAttributes.color,ee=Q!==void 0?Q.length:0,Ae=0;P.morphAttributes.position!==void 0&&(Ae=1),P.morphAttributes.normal!==void 0&&(Ae=2),P.morphAttributes.color!==void 0&&(Ae=3);let Be,$,_e,ye;if(ie){let me=Gn[ie];Be=me.vertexShader,$=me.fragmentShader}else{Be=_.vertexShader,$=_.fragmentShader;let me=o.getVertexShaderStage(_),rt=o.getFragmentShaderStage(_);o.update(_,me,rt),_e=me.id,ye=rt.id}let Ie=n.getRenderTarget(),be=n.state.buffers.depth.getReversed(),Ve=N.isInstancedMesh===!0,Mt=N.isBatchedMesh===!0,Fe=!!_.map,st=!!_.matcap,at=!!V,Ye=at&&V.isPMREMTexture===!0,Ot=!!_.aoMap,Rt=!!_.lightMap,en=!!_.bumpMap&&_.wireframe===!1,vt=!!_.normalMap,Pn=!!_.displacementMap,Lt=!!_.emissiveMap,dn=!!_.metalnessMap,fn=!!_.roughnessMap,pn=_.anisotropy>0,L=_.clearcoat>0,mn=_.diffuseRoughness>0,mt=_.dispersion>0,gt=_.retroreflectivity>0,pe=_.iridescence>0,Ct=_.sheen>0,De=_.transmission>0,Oe=pn&&!!_.anisotropyMap,E=L&&!!_.clearcoatMap,b=L&&!!_.clearcoatNormalMap,O=L&&!!_.clearcoatRoughnessMap,te=mn&&!!_.diffuseRoughnessMap,j=pe&&!!_.iridescenceMap,ae=pe&&!!_.iridescenceThicknessMap,ue=Ct&&!!_.sheenColorMap,Y=Ct&&!!_.sheenRoughnessMap,Z=!!_.specularMap,le=!!_.specularColorMap,C=!!_.specularIntensityMap,J=De&&!!_.transmissionMap,X=De&&!!_.thicknessMap,ce=!!_.gradientMap,re=!!_.alphaMap,oe=_.alphaTest>0,Re=!!_.alphaHash,We=!!_.extensions,se=Bn;_.toneMapped&&(Ie===null||Ie.isXRRenderTarget===!0)&&(se=n.toneMapping);let Ce=Ye?V.isCompressedCubeTexture?V.image[0].mipmaps:V.mipmaps:null,He={shaderID:ie,shaderType:_.type,shaderName:_.name,vertexShader:Be,fragmentShader:$,defines:_.defines,customVertexShaderID:_e,customFragmentShaderID:ye,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:q,batching:Mt,batchingColor:Mt&&N._colorsTexture!==null,instancing:Ve,instancingColor:Ve&&N.instanceColor!==null,instancingMorph:Ve&&N.morphTexture!==null,outputColorSpace:Ie===null?n.outputColorSpace:Ie.isXRRenderTarget===!0?Ie.texture.colorSpace:Je.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:Fe,matcap:st,envMap:at,envMapMode:at&&V.mapping,envMapPMREM:Ye,envMapMaxLod:Ye?Ce.length-1:null,envMapSize:Ye?Ce[0].width:null,aoMap:Ot,lightMap:Rt,bumpMap:en,normalMap:vt,displacementMap:Pn,emissiveMap:Lt,normalMapObjectSpace:vt&&_.normalMapType===ku,normalMapTangentSpace:vt&&_.normalMapType===Uo,packedNormalMap:vt&&_.normalMapType===Uo&&wb(_.normalMap.format),metalnessMap:dn,roughnessMap:fn,anisotropy:pn,anisotropyMap:Oe,clearcoat:L,clearcoatMap:E,clearcoatNormalMap:b,clearcoatRoughnessMap:O,diffuseRoughness:mn,diffuseRoughnessMap:te,dispersion:mt,retroreflection:gt,iridescence:pe,iridescenceMap:j,iridescenceThicknessMap:ae,sheen:Ct,sheenColorMap:ue,sheenRoughnessMap:Y,specularMap:Z,specularColorMap:le,specularIntensityMap:C,transmission:De,transmissionMap:J,thicknessMap:X,gradientMap:ce,opaque:_.transparent===!1&&_.blending===Ts&&_.alphaToCoverage===!1,alphaMap:re,alphaTest:oe,alphaHash:Re,combine:_.combine,mapUv:Fe&&f(_.map.channel),aoMapUv:Ot&&f(_.aoMap.channel),lightMapUv:Rt&&f(_.lightMap.channel),bumpMapUv:en&&f(_.bumpMap.channel),normalMapUv:vt&&f(_.normalMap.channel),displacementMapUv:Pn&&f(_.displacementMap.channel),emissiveMapUv:Lt&&f(_.emissiveMap.channel),metalnessMapUv:dn&&f(_.metalnessMap.channel),roughnessMapUv:fn&&f(_.roughnessMap.channel),anisotropyMapUv:Oe&&f(_.anisotropyMap.channel),clearcoatMapUv:E&&f(_.clearcoatMap.channel),clearcoatNormalMapUv:b&&f(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:O&&f(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:te&&f(_.diffuseRoughnessMap.channel),iridescenceMapUv:j&&f(_.iridescenceMap.channel),iridescenceThicknessMapUv:ae&&f(_.iridescenceThicknessMap.channel),sheenColorMapUv:ue&&f(_.sheenColorMap.channel),sheenRoughnessMapUv:Y&&f(_.sheenRoughnessMap.channel),specularMapUv:Z&&f(_.specularMap.channel),specularColorMapUv:le&&f(_.specularColorMap.channel),specularIntensityMapUv:C&&f(_.specularIntensityMap.channel),transmissionMapUv:J&&f(_.transmissionMap.channel),thicknessMapUv:X&&f(_.thicknessMap.channel),alphaMapUv:re&&f(_.alphaMap.channel),vertexTangents:!!P.attributes.tangent&&(vt||pn),vertexNormals:!!P.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!P.attributes.color&&P.attributes.color.itemSize===4,pointsUvs:N.isPoints===!0&&!!P.attributes.uv&&(Fe||re),fog:!!W,useFog:_.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||P.attributes.normal===void 0&&vt===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:d,reversedDepthBuffer:be,skinning:N.isSkinnedMesh===!0,hasPositionAttribute:P.attributes.position!==void 0,morphTargets:P.morphAttributes.position!==void 0,morphNormals:P.morphAttributes.normal!==void 0,morphColors:P.morphAttributes.color!==void 0,morphTargetsCount:ee,morphTextureStride:Ae,numSunLights:M.sun.length,numDirLights:M.directional.length,numPointLights:M.point.length,numSpotLights:M.spot.length,numSpotLightMaps:M.spotLightMap.length,numRectAreaLights:M.rectArea.length,numHemiLights:M.hemi.length,numSunLightShadows:M.sunShadowMap.length,numDirLightShadows:M.directionalShadowMap.length,numPointLightShadows:M.pointShadowMap.length,numSpotLightShadows:M.spotShadowMap.length,numSpotLightShadowsWithMaps:M.numSpotLightShadowsWithMaps,numLightProbes:M.numLightProbes,numLightProbeGrids:B.filter(me=>me.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:n.shadowMap.enabled&&U.length>0,shadowMapType:n.shadowMap.type,toneMapping:se,decodeVideoTexture:Fe&&_.map.isVideoTexture===!0&&Je.getTransfer(_.map.colorSpace)===it,decodeVideoTextureEmissive:Lt&&_.emissiveMap.isVideoTexture===!0&&Je.getTransfer(_.emissiveMap.colorSpace)===it,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===sn,flipSided:_.side===Qt,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:We&&_.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(We&&_.extensions.multiDraw===!0||Mt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return He.vertexUv1s=c.has(1),He.vertexUv2s=c.has(2),He.vertexUv3s=c.has(3),c.clear(),He}function x(_){let M=[];if(_.shaderID?M.push(_.shaderID):(M.push(_.customVertexShaderID),M.push(_.customFragmentShaderID)),_.defines!==void 0)for(let U in _.defines)M.push(U),M.push(_.defines[U]);return _.isRawShaderMaterial===!1&&(m(M,_),p(M,_),M.push(n.outputColorSpace)),M.push(_.customProgramCacheKey),M.join()}function m(_,M){_.push(M.precision),_.push(M.outputColorSpace),_.push(M.envMapMode),_.push(M.envMapPMREM),_.push(M.envMapMaxLod),_.push(M.envMapSize),_.push(M.mapUv),_.push(M.alphaMapUv),_.push(M.lightMapUv),_.push(M.aoMapUv),_.push(M.bumpMapUv),_.push(M.normalMapUv),_.push(M.displacementMapUv),_.push(M.emissiveMapUv),_.push(M.metalnessMapUv),_.push(M.roughnessMapUv),_.push(M.anisotropyMapUv),_.push(M.clearcoatMapUv),_.push(M.clearcoatNormalMapUv),_.push(M.clearcoatRoughnessMapUv),_.push(M.diffuseRoughnessMapUv),_.push(M.iridescenceMapUv),_.push(M.iridescenceThicknessMapUv),_.push(M.sheenColorMapUv),_.push(M.sheenRoughnessMapUv),_.push(M.specularMapUv),_.push(M.specularColorMapUv),_.push(M.specularIntensityMapUv),_.push(M.transmissionMapUv),_.push(M.thicknessMapUv),_.push(M.combine),_.push(M.fogExp2),_.push(M.sizeAttenuation),_.push(M.morphTargetsCount),_.push(M.numSunLights),_.push(M.numDirLights),_.push(M.numPointLights),_.push(M.numSpotLights),_.push(M.numSpotLightMaps),_.push(M.numHemiLights),_.push(M.numRectAreaLights),_.push(M.numSunLightShadows),_.push(M.numDirLightShadows),_.push(M.numPointLightShadows),_.push(M.numSpotLightShadows),_.push(M.numSpotLightShadowsWithMaps),_.push(M.numLightProbes),_.push(M.numLightProbeGrids),_.push(M.shadowMapType),_.push(M.toneMapping),_.push(M.numClippingPlanes),_.push(M.numClipIntersection),_.push(M.depthPacking)}function p(_,M){a.disableAll(),M.instancing&&a.enable(0),M.instancingColor&&a.enable(1),M.instancingMorph&&a.enable(2),M.matcap&&a.enable(3),M.envMap&&a.enable(4),M.normalMapObjectSpace&&a.enable(5),M.normalMapTangentSpace&&a.enable(6),M.clearcoat&&a.enable(7),M.iridescence&&a.enable(8),M.alphaTest&&a.enable(9),M.vertexColors&&a.enable(10),M.vertexAlphas&&a.enable(11),M.vertexUv1s&&a.enable(12),M.vertexUv2s&&a.enable(13),M.vertexUv3s&&a.enable(14),M.vertexTangents&&a.enable(15),M.anisotropy&&a.enable(16),M.alphaHash&&a.enable(17),M.batching&&a.enable(18),M.dispersion&&a.enable(19),M.retroreflection&&a.enable(24),M.diffuseRoughness&&a.enable(25),M.batchingColor&&a.enable(20),M.gradientMap&&a.enable(21),M.packedNormalMap&&a.enable(22),M.vertexNormals&&a.enable(23),_.push(a.mask),a.disableAll(),M.fog&&a.enable(0),M.useFog&&a.enable(1),M.flatShading&&a.enable(2),M.logarithmicDepthBuffer&&a.enable(3),M.reversedDepthBuffer&&a.enable(4),M.skinning&&a.enable(5),M.morphTargets&&a.enable(6),M.morphNormals&&a.enable(7),M.morphColors&&a.enable(8),M.premultipliedAlpha&&a.enable(9),M.shadowMapEnabled&&a.enable(10),M.doubleSided&&a.enable(11),M.flipSided&&a.enable(12),M.useDepthPacking&&a.enable(13),M.dithering&&a.enable(14),M.transmission&&a.enable(15),M.sheen&&a.enable(16),M.opaque&&a.enable(17),M.pointsUvs&&a.enable(18),M.decodeVideoTexture&&a.enable(19),M.decodeVideoTextureEmissive&&a.enable(20),M.alphaToCoverage&&a.enable(21),M.numLightProbeGrids>0&&a.enable(22),M.hasPositionAttribute&&a.enable(23),_.push(a.mask)}function v(_){let M=h[_.type],U;if(M){let D=Gn[M];U=Ju.clone(D.uniforms)}else U=_.uniforms;return U}function S(_,M){let U=u.get(M);return U!==void 0?++U.usedTimes:(U=new vb(n,M,_,s),l.push(U),u.set(M,U)),U}function w(_){if(--_.usedTimes===0){let M=l.indexOf(_);l[M]=l[l.length-1],l.pop(),u.delete(_.cacheKey),_.destroy()}}function T(_){o.remove(_)}function A(){o.dispose()}return{getParameters:g,getProgramCacheKey:x,getUniforms:v,acquireProgram:S,releaseProgram:w,releaseShaderCache:T,programs:l,dispose:A}}function Mb(){let n=new WeakMap;function e(a){return n.has(a)}function t(a){let o=n.get(a);return o===void 0&&(o={},n.set(a,o)),o}function i(a){n.delete(a)}function s(a,o,c){n.get(a)[o]=c}function r(){n=new WeakMap}return{has:e,get:t,remove:i,update:s,dispose:r}}function Ab(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.material.id!==e.material.id?n.material.id-e.material.id:n.materialVariant!==e.materialVariant?n.materialVariant-e.materialVariant:n.z!==e.z?n.z-e.z:n.id-e.id}function _d(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.z!==e.z?e.z-n.z:n.id-e.id}function bd(){let n=[],e=0,t=[],i=[],s=[];function r(){e=0,t.length=0,i.length=0,s.length=0}function a(h){let f=0;return h.isInstancedMesh&&(f+=2),h.isSkinnedMesh&&(f+=1),f}function o(h,f,g,x,m,p){let v=n[e];return v===void 0?(v={id:h.id,object:h,geometry:f,material:g,materialVariant:a(h),groupOrder:x,renderOrder:h.renderOrder,z:m,group:p},n[e]=v):(v.id=h.id,v.object=h,v.geometry=f,v.material=g,v.materialVariant=a(h),v.groupOrder=x,v.renderOrder=h.renderOrder,v.z=m,v.group=p),e++,v}function c(h,f,g,x,m,p,v){v.reversedDepth===!0&&(m=-m);let S=o(h,f,g,x,m,p);g.transmission>0?i.push(S):g.transparent===!0?s.push(S):t.push(S)}function l(h,f,g,x,m,p){let v=o(h,f,g,x,m,p);g.transmission>0?i.unshift(v):g.transparent===!0?s.unshift(v):t.unshift(v)}function u(h,f){t.length>1&&t.sort(h||Ab),i.length>1&&i.sort(f||_d),s.length>1&&s.sort(f||_d)}function d(){for(let h=e,f=n.length;h<f;h++){let g=n[h];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:t,transmissive:i,transparent:s,init:r,push:c,unshift:l,finish:d,sort:u}}function Tb(){let n=new WeakMap;function e(i,s){let r=n.get(i),a;return r===void 0?(a=new bd,n.set(i,[a])):s>=r.length?(a=new bd,r.push(a)):a=r[s],a}function t(){n=new WeakMap}return{get:e,dispose:t}}function Eb(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new F,color:new Xe};break;case"SpotLight":t={position:new F,direction:new F,color:new Xe,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new F,color:new Xe,distance:0,decay:0};break;case"HemisphereLight":t={direction:new F,skyColor:new Xe,groundColor:new Xe};break;case"RectAreaLight":t={color:new Xe,position:new F,halfWidth:new F,halfHeight:new F};break}return n[e.id]=t,t}}}function Rb(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new je};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new je};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new je,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[e.id]=t,t}}}var Cb=0;function Pb(n,e){return(e.castShadow?2:0)-(n.castShadow?2:0)+(e.map?1:0)-(n.map?1:0)}function Ib(n){let e=new Eb,t=Rb(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let l=0;l<9;l++)i.probe.push(new F);let s=new F,r=new ct,a=new ct;function o(l){let u=0,d=0,h=0;for(let B=0;B<9;B++)i.probe[B].set(0,0,0);let f=0,g=0,x=0,m=0,p=0,v=0,S=0,w=0,T=0,A=0,_=0,M=0,U=0,D=0;l.sort(Pb);for(let B=0,W=l.length;B<W;B++){let P=l[B],H=P.color,K=P.intensity,V=P.distance,ie=null;if(P.shadow&&P.shadow.map&&(P.shadow.map.texture.format===Ei?ie=P.shadow.map.texture:ie=P.shadow.map.depthTexture||P.shadow.map.texture),P.isAmbientLight)u+=H.r*K,d+=H.g*K,h+=H.b*K;else if(P.isLightProbe){for(let q=0;q<9;q++)i.probe[q].addScaledVector(P.sh.coefficients[q],K);D++}else if(P.isSunLight){let q=e.get(P);if(q.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let Q=P.shadow,ee=t.get(P);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),i.sunShadow[g]=ee,i.sunShadowMap[g]=ie;let Ae=Q.getViewportCount();for(let Be=0;Be<Ae;Be++)i.sunShadowMatrix[x+Be]=Q.getMatrix(Be),i.sunShadowCascade[x+Be]=Q._cascadeData[Be];x+=Ae,g++}i.sun[f]=q,f++}else if(P.isDirectionalLight){let q=e.get(P);if(q.color.copy(P.color).multiplyScalar(P.intensity),P.castShadow){let Q=P.shadow,ee=t.get(P);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize=Q.mapSize,i.directionalShadow[m]=ee,i.directionalShadowMap[m]=ie,i.directionalShadowMatrix[m]=P.shadow.matrix,T++}i.directional[m]=q,m++}else if(P.isSpotLight){let q=e.get(P);q.position.setFromMatrixPosition(P.matrixWorld),q.color.copy(H).multiplyScalar(K),q.distance=V,q.coneCos=Math.cos(P.angle),q.penumbraCos=Math.cos(P.angle*(1-P.penumbra)),q.decay=P.decay,i.spot[v]=q;let Q=P.shadow;if(P.map&&(i.spotLightMap[M]=P.map,M++,Q.updateMatrices(P),P.castShadow&&U++),i.spotLightMatrix[v]=Q.matrix,P.castShadow){let ee=t.get(P);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize=Q.mapSize,i.spotShadow[v]=ee,i.spotShadowMap[v]=ie,_++}v++}else if(P.isRectAreaLight){let q=e.get(P);q.color.copy(H).multiplyScalar(K),q.halfWidth.set(P.width*.5,0,0),q.halfHeight.set(0,P.height*.5,0),i.rectArea[S]=q,S++}else if(P.isPointLight){let q=e.get(P);if(q.color.copy(P.color).multiplyScalar(P.intensity),q.distance=P.distance,q.decay=P.decay,P.castShadow){let Q=P.shadow,ee=t.get(P);ee.shadowIntensity=Q.intensity,ee.shadowBias=Q.bias,ee.shadowNormalBias=Q.normalBias,ee.shadowRadius=Q.radius,ee.shadowMapSize=Q.mapSize,ee.shadowCameraNear=Q.camera.near,ee.shadowCameraFar=Q.camera.far,i.pointShadow[p]=ee,i.pointShadowMap[p]=ie,i.pointShadowMatrix[p]=P.shadow.matrix,A++}i.point[p]=q,p++}else if(P.isHemisphereLight){let q=e.get(P);q.skyColor.copy(P.color).multiplyScalar(K),q.groundColor.copy(P.groundColor).multiplyScalar(K),i.hemi[w]=q,w++}}S>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=ge.LTC_FLOAT_1,i.rectAreaLTC2=ge.LTC_FLOAT_2):(i.rectAreaLTC1=ge.LTC_HALF_1,i.rectAreaLTC2=ge.LTC_HALF_2)),i.ambient[0]=u,i.ambient[1]=d,i.ambient[2]=h;let N=i.hash;(N.sunLength!==f||N.directionalLength!==m||N.pointLength!==p||N.spotLength!==v||N.rectAreaLength!==S||N.hemiLength!==w||N.numSunShadows!==g||N.numDirectionalShadows!==T||N.numPointShadows!==A||N.numSpotShadows!==_||N.numSpotMaps!==M||N.numLightProbes!==D)&&(i.sun.length=f,i.directional.length=m,i.spot.length=v,i.rectArea.length=S,i.point.length=p,i.hemi.length=w,i.sunShadow.length=g,i.sunShadowMap.length=g,i.sunShadowMatrix.length=x,i.sunShadowCascade.length=x,i.directionalShadow.length=T,i.directionalShadowMap.length=T,i.directionalShadowMatrix.length=T,i.pointShadow.length=A,i.pointShadowMap.length=A,i.pointShadowMatrix.length=A,i.spotShadow.length=_,i.spotShadowMap.length=_,i.spotLightMatrix.length=_+M-U,i.spotLightMap.length=M,i.numSpotLightShadowsWithMaps=U,i.numLightProbes=D,N.sunLength=f,N.directionalLength=m,N.pointLength=p,N.spotLength=v,N.rectAreaLength=S,N.hemiLength=w,N.numSunShadows=g,N.numDirectionalShadows=T,N.numPointShadows=A,N.numSpotShadows=_,N.numSpotMaps=M,N.numLightProbes=D,i.version=Cb++)}function c(l,u){let d=0,h=0,f=0,g=0,x=0,m=0,p=u.matrixWorldInverse;for(let v=0,S=l.length;v<S;v++){let w=l[v];if(w.isSunLight){let T=i.sun[d];T.direction.setFromMatrixPosition(w.matrixWorld),T.direction.transformDirection(p),d++}else if(w.isDirectionalLight){let T=i.directional[h];T.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),T.direction.sub(s),T.direction.transformDirection(p),h++}else if(w.isSpotLight){let T=i.spot[g];T.position.setFromMatrixPosition(w.matrixWorld),T.position.applyMatrix4(p),T.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),T.direction.sub(s),T.direction.transformDirection(p),g++}else if(w.isRectAreaLight){let T=i.rectArea[x];T.position.setFromMatrixPosition(w.matrixWorld),T.position.applyMatrix4(p),a.identity(),r.copy(w.matrixWorld),r.premultiply(p),a.extractRotation(r),T.halfWidth.set(w.width*.5,0,0),T.halfHeight.set(0,w.height*.5,0),T.halfWidth.applyMatrix4(a),T.halfHeight.applyMatrix4(a),x++}else if(w.isPointLight){let T=i.point[f];T.position.setFromMatrixPosition(w.matrixWorld),T.position.applyMatrix4(p),f++}else if(w.isHemisphereLight){let T=i.hemi[m];T.direction.setFromMatrixPosition(w.matrixWorld),T.direction.transformDirection(p),m++}}}return{setup:o,setupView:c,state:i}}function xd(n){let e=new Ib(n),t=[],i=[],s=[];function r(d){u.camera=d,t.length=0,i.length=0,s.length=0}function a(d){d.isLightProbeGrid?s.push(d):t.push(d)}function o(d){i.push(d)}function c(){e.setup(t),s.sort((d,h)=>d.priority-h.priority||d.id-h.id)}function l(d){e.setupView(t,d)}let u={lightsArray:t,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:u,setupLights:c,setupLightsView:l,pushLight:a,pushShadow:o}}function Db(n){let e=new WeakMap;function t(s,r=0){let a=e.get(s),o;return a===void 0?(o=new xd(n),e.set(s,[o])):r>=a.length?(o=new xd(n),a.push(o)):o=a[r],o}function i(){e=new WeakMap}return{get:t,dispose:i}}var Lb=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,Nb=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,Fb=[new F(1,0,0),new F(-1,0,0),new F(0,1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1)],Ub=[new F(0,-1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1),new F(0,-1,0),new F(0,-1,0)],vd=new ct,Ar=new F,bc=new F;function kb(n,e,t){let i=new vi,s=new je,r=new je,a=new xt,o=new Fa,c=new Ua,l={},u=t.maxTextureSize,d={[Ti]:Qt,[Qt]:Ti,[sn]:sn},h=new On({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new je},radius:{value:4}},vertexShader:Lb,fragmentShader:Nb}),f=h.clone();f.defines.HORIZONTAL_PASS=1;let g=new nn;g.setAttribute("position",new Un(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new Et(g,h),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=gr;let p=this.type;this.render=function(A,_,M){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||A.length===0)return;this.type===pu&&(Le("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=gr);let U=n.getRenderTarget(),D=n.getActiveCubeFace(),N=n.getActiveMipmapLevel(),B=n.state;B.setBlending(qi),B.buffers.depth.getReversed()===!0?B.buffers.color.setClear(0,0,0,0):B.buffers.color.setClear(1,1,1,1),B.buffers.depth.setTest(!0),B.setScissorTest(!1);let W=p!==this.type;W&&_.traverse(function(P){P.material&&(Array.isArray(P.material)?P.material.forEach(H=>H.needsUpdate=!0):P.material.needsUpdate=!0)});for(let P=0,H=A.length;P<H;P++){let K=A[P],V=K.shadow;if(V===void 0){Le("WebGLShadowMap:",K,"has no shadow.");continue}if(V.autoUpdate===!1&&V.needsUpdate===!1)continue;s.copy(V.mapSize);let ie=V.getFrameExtents();s.multiply(ie),r.copy(V.mapSize),(s.x>u||s.y>u)&&(s.x>u&&(r.x=Math.floor(u/ie.x),s.x=r.x*ie.x,V.mapSize.x=r.x),s.y>u&&(r.y=Math.floor(u/ie.y),s.y=r.y*ie.y,V.mapSize.y=r.y));let q=n.state.buffers.depth.getReversed();if(V.camera._reversedDepth=q,V.map===null||W===!0){if(V.map!==null&&(V.map.depthTexture!==null&&(V.map.depthTexture.dispose(),V.map.depthTexture=null),V.map.dispose()),this.type===As){if(K.isPointLight){Le("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}V.map=new hn(s.x,s.y,{format:Ei,type:En,minFilter:Jt,magFilter:Jt,generateMipmaps:!1}),V.map.texture.name=K.name+".shadowMap",V.map.depthTexture=new ii(s.x,s.y,Tn),V.map.depthTexture.name=K.name+".shadowMapDepth",V.map.depthTexture.format=ei,V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=St,V.map.depthTexture.magFilter=St}else K.isPointLight?(V.map=new Er(s.x),V.map.depthTexture=new lr(s.x,An)):(V.map=new hn(s.x,s.y),V.map.depthTexture=new ii(s.x,s.y,An)),V.map.depthTexture.name=K.name+".shadowMap",V.map.depthTexture.format=ei,this.type===gr?(V.map.depthTexture.compareFunction=q?lc:oc,V.map.depthTexture.minFilter=Jt,V.map.depthTexture.magFilter=Jt):(V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=St,V.map.depthTexture.magFilter=St);V.camera.updateProjectionMatrix()}V.map.isWebGLCubeRenderTarget!==!0&&(V.map.width!==s.x||V.map.height!==s.y)&&V.map.setSize(s.x,s.y);let Q=V.map.isWebGLCubeRenderTarget?6:V.getViewportCount();K.isPointLight!==!0&&V.updateMatrices(K,M);let ee=(V.camera.layers.mask&4294967294)!==0?V.camera.layers:M.layers;for(let Ae=0;Ae<Q;Ae++){let Be=V.getCamera(Ae);if(K.isPointLight){let $=V.camera,_e=V.matrix,ye=K.distance||$.far;ye!==$.far&&($.far=ye,$.updateProjectionMatrix()),Ar.setFromMatrixPosition(K.matrixWorld),$.position.copy(Ar),bc.copy($.position),bc.add(Fb[Ae]),$.up.copy(Ub[Ae]),$.lookAt(bc),$.updateMatrixWorld(),_e.makeTranslation(-Ar.x,-Ar.y,-Ar.z),vd.multiplyMatrices($.projectionMatrix,$.matrixWorldInverse),V._frustum.setFromProjectionMatrix(vd,$.coordinateSystem,$.reversedDepth)}if(V.map.isWebGLCubeRenderTarget)n.setRenderTarget(V.map,Ae),n.clear();else{Ae===0&&(n.setRenderTarget(V.map),n.clear());let $=V.getViewport(Ae);a.set(r.x*$.x,r.y*$.y,r.x*$.z,r.y*$.w),B.viewport(a)}i=V.getFrustum(Ae),w(_,M,Be,K,ee,this.type)}V.isPointLightShadow!==!0&&this.type===As&&v(V,M),V.needsUpdate=!1}p=this.type,m.needsUpdate=!1,n.setRenderTarget(U,D,N)};function v(A,_){let M=e.update(x);h.defines.VSM_SAMPLES!==A.blurSamples&&(h.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,h.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new hn(s.x,s.y,{format:Ei,type:En}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),h.uniforms.shadow_pass.value=A.map.depthTexture,h.uniforms.resolution.value.set(A.map.width,A.map.height),h.uniforms.radius.value=A.radius,n.setRenderTarget(A.mapPass),n.clear(),n.renderBufferDirect(_,null,M,h,x,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,n.setRenderTarget(A.map),n.clear(),n.renderBufferDirect(_,null,M,f,x,null)}function S(A,_,M,U){let D=null,N=M.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(N!==void 0)D=N;else if(D=M.isPointLight===!0?c:o,n.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let B=D.uuid,W=_.uuid,P=l[B];P===void 0&&(P={},l[B]=P);let H=P[W];H===void 0&&(H=D.clone(),P[W]=H,_.addEventListener("dispose",T)),D=H}if(D.visible=_.visible,D.wireframe=_.wireframe,U===As?D.side=_.shadowSide!==null?_.shadowSide:_.side:D.side=_.shadowSide!==null?_.shadowSide:d[_.side],D.alphaMap=_.alphaMap,D.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,D.map=_.map,D.clipShadows=_.clipShadows,D.clippingPlanes=_.clippingPlanes,D.clipIntersection=_.clipIntersection,D.displacementMap=_.displacementMap,D.displacementScale=_.displacementScale,D.displacementBias=_.displacementBias,D.wireframeLinewidth=_.wireframeLinewidth,D.linewidth=_.linewidth,M.isPointLight===!0&&D.isMeshDistanceMaterial===!0){let B=n.properties.get(D);B.light=M}return D}function w(A,_,M,U,D,N){if(A.visible===!1)return;if(A.layers.test(D)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&N===As)&&(!A.frustumCulled||A.intersectsFrustum(i))){A.modelViewMatrix.multiplyMatrices(M.matrixWorldInverse,A.matrixWorld);let P=e.update(A),H=A.material;if(Array.isArray(H)){let K=P.groups;for(let V=0,ie=K.length;V<ie;V++){let q=K[V],Q=H[q.materialIndex];if(Q&&Q.visible){let ee=S(A,Q,U,N);A.onBeforeShadow(n,A,_,M,P,ee,q),n.renderBufferDirect(M,null,P,ee,A,q),A.onAfterShadow(n,A,_,M,P,ee,q)}}}else if(H.visible){let K=S(A,H,U,N);A.onBeforeShadow(n,A,_,M,P,K,null),n.renderBufferDirect(M,null,P,K,A,null),A.onAfterShadow(n,A,_,M,P,K,null)}}let W=A.children;for(let P=0,H=W.length;P<H;P++)w(W[P],_,M,U,D,N)}function T(A){A.target.removeEventListener("dispose",T);for(let M in l){let U=l[M],D=A.target.uuid;D in U&&(U[D].dispose(),delete U[D])}}}function Ob(n,e){function t(){let C=!1,J=new xt,X=null,ce=new xt(0,0,0,0);return{setMask:function(re){X!==re&&!C&&(n.colorMask(re,re,re,re),X=re)},setLocked:function(re){C=re},setClear:function(re,oe,Re,We,se){se===!0&&(re*=We,oe*=We,Re*=We),J.set(re,oe,Re,We),ce.equals(J)===!1&&(n.clearColor(re,oe,Re,We),ce.copy(J))},reset:function(){C=!1,X=null,ce.set(-1,0,0,0)}}}function i(){let C=!1,J=!1,X=null,ce=null,re=null;return{setReversed:function(oe){if(J!==oe){let Re=e.get("EXT_clip_control");oe?Re.clipControlEXT(Re.LOWER_LEFT_EXT,Re.ZERO_TO_ONE_EXT):Re.clipControlEXT(Re.LOWER_LEFT_EXT,Re.NEGATIVE_ONE_TO_ONE_EXT),J=oe;let We=re;re=null,this.setClear(We)}},getReversed:function(){return J},setTest:function(oe){oe?be(n.DEPTH_TEST):Ve(n.DEPTH_TEST)},setMask:function(oe){X!==oe&&!C&&(n.depthMask(oe),X=oe)},setFunc:function(oe){if(J&&(oe=Yu[oe]),ce!==oe){switch(oe){case ma:n.depthFunc(n.NEVER);break;case ga:n.depthFunc(n.ALWAYS);break;case _a:n.depthFunc(n.LESS);break;case _s:n.depthFunc(n.LEQUAL);break;case ba:n.depthFunc(n.EQUAL);break;case xa:n.depthFunc(n.GEQUAL);break;case va:n.depthFunc(n.GREATER);break;case ya:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}ce=oe}},setLocked:function(oe){C=oe},setClear:function(oe){re!==oe&&(re=oe,J&&(oe=1-oe),n.clearDepth(oe))},reset:function(){C=!1,X=null,ce=null,re=null,J=!1}}}function s(){let C=!1,J=null,X=null,ce=null,re=null,oe=null,Re=null,We=null,se=null;return{setTest:function(Ce){C||(Ce?be(n.STENCIL_TEST):Ve(n.STENCIL_TEST))},setMask:function(Ce){J!==Ce&&!C&&(n.stencilMask(Ce),J=Ce)},setFunc:function(Ce,He,me){(X!==Ce||ce!==He||re!==me)&&(n.stencilFunc(Ce,He,me),X=Ce,ce=He,re=me)},setOp:function(Ce,He,me){(oe!==Ce||Re!==He||We!==me)&&(n.stencilOp(Ce,He,me),oe=Ce,Re=He,We=me)},setLocked:function(Ce){C=Ce},setClear:function(Ce){se!==Ce&&(n.clearStencil(Ce),se=Ce)},reset:function(){C=!1,J=null,X=null,ce=null,re=null,oe=null,Re=null,We=null,se=null}}}let r=new t,a=new i,o=new s,c={},l=new WeakMap,u={},d={},h={},f=new WeakMap,g=[],x=null,m=!1,p=null,v=null,S=null,w=null,T=null,A=null,_=null,M=new Xe(0,0,0),U=0,D=!1,N=null,B=null,W=null,P=null,H=null,K=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),V=!1,ie=0,q=n.getParameter(n.VERSION);q.indexOf("WebGL")!==-1?(ie=parseFloat(/^WebGL (\d)/.exec(q)[1]),V=ie>=1):q.indexOf("OpenGL ES")!==-1&&(ie=parseFloat(/^OpenGL ES (\d)/.exec(q)[1]),V=ie>=2);let Q=null,ee={},Ae=n.getParameter(n.SCISSOR_BOX),Be=n.getParameter(n.VIEWPORT),$=new xt().fromArray(Ae),_e=new xt().fromArray(Be);function ye(C,J,X,ce){let re=new Uint8Array(4),oe=n.createTexture();n.bindTexture(C,oe),n.texParameteri(C,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(C,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let Re=0;Re<X;Re++)C===n.TEXTURE_3D||C===n.TEXTURE_2D_ARRAY?n.texImage3D(J,0,n.RGBA,1,1,ce,0,n.RGBA,n.UNSIGNED_BYTE,re):n.texImage2D(J+Re,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,re);return oe}let Ie={};Ie[n.TEXTURE_2D]=ye(n.TEXTURE_2D,n.TEXTURE_2D,1),Ie[n.TEXTURE_CUBE_MAP]=ye(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ie[n.TEXTURE_2D_ARRAY]=ye(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Ie[n.TEXTURE_3D]=ye(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),a.setClear(1),o.setClear(0),be(n.DEPTH_TEST),a.setFunc(_s),en(!1),vt(zl),be(n.CULL_FACE),Ot(qi);function be(C){u[C]!==!0&&(n.enable(C),u[C]=!0)}function Ve(C){u[C]!==!1&&(n.disable(C),u[C]=!1)}function Mt(C,J){return h[C]!==J?(n.bindFramebuffer(C,J),h[C]=J,C===n.DRAW_FRAMEBUFFER&&(h[n.FRAMEBUFFER]=J),C===n.FRAMEBUFFER&&(h[n.DRAW_FRAMEBUFFER]=J),!0):!1}function Fe(C,J){let X=g,ce=!1;if(C){X=f.get(J),X===void 0&&(X=[],f.set(J,X));let re=C.textures;if(X.length!==re.length||X[0]!==n.COLOR_ATTACHMENT0){for(let oe=0,Re=re.length;oe<Re;oe++)X[oe]=n.COLOR_ATTACHMENT0+oe;X.length=re.length,ce=!0}}else X[0]!==n.BACK&&(X[0]=n.BACK,ce=!0);ce&&n.drawBuffers(X)}function st(C){return x!==C?(n.useProgram(C),x=C,!0):!1}let at={[Ki]:n.FUNC_ADD,[gu]:n.FUNC_SUBTRACT,[_u]:n.FUNC_REVERSE_SUBTRACT};at[bu]=n.MIN,at[xu]=n.MAX;let Ye={[vu]:n.ZERO,[yu]:n.ONE,[wu]:n.SRC_COLOR,[Wl]:n.SRC_ALPHA,[Ru]:n.SRC_ALPHA_SATURATE,[Tu]:n.DST_COLOR,[Mu]:n.DST_ALPHA,[Su]:n.ONE_MINUS_SRC_COLOR,[Xl]:n.ONE_MINUS_SRC_ALPHA,[Eu]:n.ONE_MINUS_DST_COLOR,[Au]:n.ONE_MINUS_DST_ALPHA,[Cu]:n.CONSTANT_COLOR,[Pu]:n.ONE_MINUS_CONSTANT_COLOR,[Iu]:n.CONSTANT_ALPHA,[Du]:n.ONE_MINUS_CONSTANT_ALPHA};function Ot(C,J,X,ce,re,oe,Re,We,se,Ce){if(C===qi){m===!0&&(Ve(n.BLEND),m=!1);return}if(m===!1&&(be(n.BLEND),m=!0),C!==mu){if(C!==p||Ce!==D){if((v!==Ki||T!==Ki)&&(n.blendEquation(n.FUNC_ADD),v=Ki,T=Ki),Ce)switch(C){case Ts:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Gl:n.blendFunc(n.ONE,n.ONE);break;case Vl:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case Hl:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Ue("WebGLState: Invalid blending: ",C);break}else switch(C){case Ts:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Gl:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case Vl:Ue("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Hl:Ue("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Ue("WebGLState: Invalid blending: ",C);break}S=null,w=null,A=null,_=null,M.set(0,0,0),U=0,p=C,D=Ce}return}re=re||J,oe=oe||X,Re=Re||ce,(J!==v||re!==T)&&(n.blendEquationSeparate(at[J],at[re]),v=J,T=re),(X!==S||ce!==w||oe!==A||Re!==_)&&(n.blendFuncSeparate(Ye[X],Ye[ce],Ye[oe],Ye[Re]),S=X,w=ce,A=oe,_=Re),(We.equals(M)===!1||se!==U)&&(n.blendColor(We.r,We.g,We.b,se),M.copy(We),U=se),p=C,D=!1}function Rt(C,J){C.side===sn?Ve(n.CULL_FACE):be(n.CULL_FACE);let X=C.side===Qt;J&&(X=!X),en(X),C.blending===Ts&&C.transparent===!1?Ot(qi):Ot(C.blending,C.blendEquation,C.blendSrc,C.blendDst,C.blendEquationAlpha,C.blendSrcAlpha,C.blendDstAlpha,C.blendColor,C.blendAlpha,C.premultipliedAlpha),a.setFunc(C.depthFunc),a.setTest(C.depthTest),a.setMask(C.depthWrite),r.setMask(C.colorWrite);let ce=C.stencilWrite;o.setTest(ce),ce&&(o.setMask(C.stencilWriteMask),o.setFunc(C.stencilFunc,C.stencilRef,C.stencilFuncMask),o.setOp(C.stencilFail,C.stencilZFail,C.stencilZPass)),Lt(C.polygonOffset,C.polygonOffsetFactor,C.polygonOffsetUnits),C.alphaToCoverage===!0?be(n.SAMPLE_ALPHA_TO_COVERAGE):Ve(n.SAMPLE_ALPHA_TO_COVERAGE)}function en(C){N!==C&&(C?n.frontFace(n.CW):n.frontFace(n.CCW),N=C)}function vt(C){C!==du?(be(n.CULL_FACE),C!==B&&(C===zl?n.cullFace(n.BACK):C===fu?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Ve(n.CULL_FACE),B=C}function Pn(C){C!==W&&(V&&n.lineWidth(C),W=C)}function Lt(C,J,X){C?(be(n.POLYGON_OFFSET_FILL),(P!==J||H!==X)&&(P=J,H=X,a.getReversed()&&(J=-J,X=-X),n.polygonOffset(J,X))):Ve(n.POLYGON_OFFSET_FILL)}function dn(C){C?be(n.SCISSOR_TEST):Ve(n.SCISSOR_TEST)}function fn(C){C===void 0&&(C=n.TEXTURE0+K-1),Q!==C&&(n.activeTexture(C),Q=C)}function pn(C,J,X){X===void 0&&(Q===null?X=n.TEXTURE0+K-1:X=Q);let ce=ee[X];ce===void 0&&(ce={type:void 0,texture:void 0},ee[X]=ce),(ce.type!==C||ce.texture!==J)&&(Q!==X&&(n.activeTexture(X),Q=X),n.bindTexture(C,J||Ie[C]),ce.type=C,ce.texture=J)}function L(){let C=ee[Q];C!==void 0&&C.type!==void 0&&(n.bindTexture(C.type,null),C.type=void 0,C.texture=void 0)}function mn(){try{n.compressedTexImage2D(...arguments)}catch(C){Ue("WebGLState:",C)}}function mt(){try{n.compressedTexImage3D(...arguments)}catch(C){Ue("WebGLState:",C)}}function gt(){try{n.texSubImage2D(...arguments)}catch(C){Ue("WebGLState:",C)}}function pe(){try{n.texSubImage3D(...arguments)}catch(C){Ue("WebGLState:",C)}}function Ct(){try{n.compressedTexSubImage2D(...arguments)}catch(C){Ue("WebGLState:",C)}}function De(){try{n.compressedTexSubImage3D(...arguments)}catch(C){Ue("WebGLState:",C)}}function Oe(){try{n.texStorage2D(...arguments)}catch(C){Ue("WebGLState:",C)}}function E(){try{n.texStorage3D(...arguments)}catch(C){Ue("WebGLState:",C)}}function b(){try{n.texImage2D(...arguments)}catch(C){Ue("WebGLState:",C)}}function O(){try{n.texImage3D(...arguments)}catch(C){Ue("WebGLState:",C)}}function te(C){return d[C]!==void 0?d[C]:n.getParameter(C)}function j(C,J){d[C]!==J&&(n.pixelStorei(C,J),d[C]=J)}function ae(C){$.equals(C)===!1&&(n.scissor(C.x,C.y,C.z,C.w),$.copy(C))}function ue(C){_e.equals(C)===!1&&(n.viewport(C.x,C.y,C.z,C.w),_e.copy(C))}function Y(C,J){let X=l.get(J);X===void 0&&(X=new WeakMap,l.set(J,X));let ce=X.get(C);ce===void 0&&(ce=n.getUniformBlockIndex(J,C.name),n.uniformBlockBinding(J,ce,ce),X.set(C,ce))}function Z(C,J,X){let re=l.get(J).get(C);c[re]!==X&&(n.bindBufferBase(n.UNIFORM_BUFFER,re,X),c[re]=X)}function le(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),a.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),u={},d={},Q=null,ee={},h={},c={},f=new WeakMap,g=[],x=null,m=!1,p=null,v=null,S=null,w=null,T=null,A=null,_=null,M=new Xe(0,0,0),U=0,D=!1,N=null,B=null,W=null,P=null,H=null,$.set(0,0,n.canvas.width,n.canvas.height),_e.set(0,0,n.canvas.width,n.canvas.height),r.reset(),a.reset(),o.reset()}return{buffers:{color:r,depth:a,stencil:o},enable:be,disable:Ve,bindFramebuffer:Mt,drawBuffers:Fe,useProgram:st,setBlending:Ot,setMaterial:Rt,setFlipSided:en,setCullFace:vt,setLineWidth:Pn,setPolygonOffset:Lt,setScissorTest:dn,activeTexture:fn,bindTexture:pn,unbindTexture:L,compressedTexImage2D:mn,compressedTexImage3D:mt,texImage2D:b,texImage3D:O,pixelStorei:j,getParameter:te,updateUBOMapping:Y,uniformBlockBinding:Z,texStorage2D:Oe,texStorage3D:E,texSubImage2D:gt,texSubImage3D:pe,compressedTexSubImage2D:Ct,compressedTexSubImage3D:De,scissor:ae,viewport:ue,reset:le}}function Bb(n,e,t,i,s,r,a){let o=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,c=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),l=new je,u=new WeakMap,d=new Set,h,f=new WeakMap,g=new Set,x=new FinalizationRegistry(E=>g.delete(E)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function p(E,b){return m?new OffscreenCanvas(E,b):js("canvas")}function v(E,b,O){let te=1,j=Oe(E);if((j.width>O||j.height>O)&&(te=O/Math.max(j.width,j.height)),te<1)if(typeof HTMLImageElement<"u"&&E instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&E instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&E instanceof ImageBitmap||typeof VideoFrame<"u"&&E instanceof VideoFrame){let ae=Math.floor(te*j.width),ue=Math.floor(te*j.height);h===void 0&&(h=p(ae,ue));let Y=b?p(ae,ue):h;return Y.width=ae,Y.height=ue,Y.getContext("2d").drawImage(E,0,0,ae,ue),Le("WebGLRenderer: Texture has been resized from ("+j.width+"x"+j.height+") to ("+ae+"x"+ue+")."),Y}else return"data"in E&&Le("WebGLRenderer: Image in DataTexture is too big ("+j.width+"x"+j.height+")."),E;return E}function S(E){return E.generateMipmaps}function w(E){n.generateMipmap(E)}function T(E){return E.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:E.isWebGL3DRenderTarget?n.TEXTURE_3D:E.isWebGLArrayRenderTarget||E.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function A(E,b,O,te,j,ae=!1){if(E!==null){if(n[E]!==void 0)return n[E];Le("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+E+"'")}let ue;te&&(ue=e.get("EXT_texture_norm16"),ue||Le("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Y=b;if(b===n.RED&&(O===n.FLOAT&&(Y=n.R32F),O===n.HALF_FLOAT&&(Y=n.R16F),O===n.UNSIGNED_BYTE&&(Y=n.R8),O===n.UNSIGNED_SHORT&&ue&&(Y=ue.R16_EXT),O===n.SHORT&&ue&&(Y=ue.R16_SNORM_EXT)),b===n.RED_INTEGER&&(O===n.UNSIGNED_BYTE&&(Y=n.R8UI),O===n.UNSIGNED_SHORT&&(Y=n.R16UI),O===n.UNSIGNED_INT&&(Y=n.R32UI),O===n.BYTE&&(Y=n.R8I),O===n.SHORT&&(Y=n.R16I),O===n.INT&&(Y=n.R32I)),b===n.RG&&(O===n.FLOAT&&(Y=n.RG32F),O===n.HALF_FLOAT&&(Y=n.RG16F),O===n.UNSIGNED_BYTE&&(Y=n.RG8),O===n.UNSIGNED_SHORT&&ue&&(Y=ue.RG16_EXT),O===n.SHORT&&ue&&(Y=ue.RG16_SNORM_EXT)),b===n.RG_INTEGER&&(O===n.UNSIGNED_BYTE&&(Y=n.RG8UI),O===n.UNSIGNED_SHORT&&(Y=n.RG16UI),O===n.UNSIGNED_INT&&(Y=n.RG32UI),O===n.BYTE&&(Y=n.RG8I),O===n.SHORT&&(Y=n.RG16I),O===n.INT&&(Y=n.RG32I)),b===n.RGB_INTEGER&&(O===n.UNSIGNED_BYTE&&(Y=n.RGB8UI),O===n.UNSIGNED_SHORT&&(Y=n.RGB16UI),O===n.UNSIGNED_INT&&(Y=n.RGB32UI),O===n.BYTE&&(Y=n.RGB8I),O===n.SHORT&&(Y=n.RGB16I),O===n.INT&&(Y=n.RGB32I)),b===n.RGBA_INTEGER&&(O===n.UNSIGNED_BYTE&&(Y=n.RGBA8UI),O===n.UNSIGNED_SHORT&&(Y=n.RGBA16UI),O===n.UNSIGNED_INT&&(Y=n.RGBA32UI),O===n.BYTE&&(Y=n.RGBA8I),O===n.SHORT&&(Y=n.RGBA16I),O===n.INT&&(Y=n.RGBA32I)),b===n.RGB&&(O===n.UNSIGNED_SHORT&&ue&&(Y=ue.RGB16_EXT),O===n.SHORT&&ue&&(Y=ue.RGB16_SNORM_EXT),O===n.UNSIGNED_INT_5_9_9_9_REV&&(Y=n.RGB9_E5),O===n.UNSIGNED_INT_10F_11F_11F_REV&&(Y=n.R11F_G11F_B10F)),b===n.RGBA){let Z=ae?Js:Je.getTransfer(j);O===n.FLOAT&&(Y=n.RGBA32F),O===n.HALF_FLOAT&&(Y=n.RGBA16F),O===n.UNSIGNED_BYTE&&(Y=Z===it?n.SRGB8_ALPHA8:n.RGBA8),O===n.UNSIGNED_SHORT&&ue&&(Y=ue.RGBA16_EXT),O===n.SHORT&&ue&&(Y=ue.RGBA16_SNORM_EXT),O===n.UNSIGNED_SHORT_4_4_4_4&&(Y=n.RGBA4),O===n.UNSIGNED_SHORT_5_5_5_1&&(Y=n.RGB5_A1)}return(Y===n.R16F||Y===n.R32F||Y===n.RG16F||Y===n.RG32F||Y===n.RGBA16F||Y===n.RGBA32F)&&e.get("EXT_color_buffer_float"),Y}function _(E,b){let O;return E?b===null||b===An||b===Zi?O=n.DEPTH24_STENCIL8:b===Tn?O=n.DEPTH32F_STENCIL8:b===Rs&&(O=n.DEPTH24_STENCIL8,Le("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):b===null||b===An||b===Zi?O=n.DEPTH_COMPONENT24:b===Tn?O=n.DEPTH_COMPONENT32F:b===Rs&&(O=n.DEPTH_COMPONENT16),O}function M(E,b){return S(E)===!0||E.isFramebufferTexture&&E.minFilter!==St&&E.minFilter!==Jt?Math.log2(Math.max(b.width,b.height))+1:E.mipmaps.length>0?E.mipmaps.length:E.isCompressedTexture&&Array.isArray(E.image)?b.mipmaps.length:1}function U(E){let b=new WeakRef(E);i.get(E).__ref=b,g.add(b),x.register(E,b,b)}function D(E){let b=i.get(E).__ref;b!==void 0&&(g.delete(b),x.unregister(b))}function N(E){W(E.target)}function B(E){P(E.target)}function W(E){E.removeEventListener("dispose",N),D(E),K(E),E.isVideoTexture&&u.delete(E),E.isHTMLTexture&&d.delete(E)}function P(E){E.removeEventListener("dispose",B),D(E),ie(E)}function H(){for(let E of g){let b=E.deref();b!==void 0&&(b.isRenderTarget===!0?P(b):W(b))}g.clear(),d.clear()}function K(E){let b=i.get(E);if(b.__webglInit===void 0)return;let O=E.source,te=f.get(O);if(te){let j=te[b.__cacheKey];j.usedTimes--,j.usedTimes===0&&V(E),Object.keys(te).length===0&&f.delete(O)}i.remove(E)}function V(E){let b=i.get(E);n.deleteTexture(b.__webglTexture);let O=E.source,te=f.get(O);delete te[b.__cacheKey],a.memory.textures--}function ie(E){let b=i.get(E);b.__depthDisposeCallback&&b.__depthDisposeCallback();let O=E.depthTexture;if(O&&O.renderTarget===E&&W(O),E.isWebGLCubeRenderTarget)for(let j=0;j<6;j++){if(Array.isArray(b.__webglFramebuffer[j]))for(let ae=0;ae<b.__webglFramebuffer[j].length;ae++)n.deleteFramebuffer(b.__webglFramebuffer[j][ae]);else n.deleteFramebuffer(b.__webglFramebuffer[j]);b.__webglDepthbuffer&&n.deleteRenderbuffer(b.__webglDepthbuffer[j])}else{if(Array.isArray(b.__webglFramebuffer))for(let j=0;j<b.__webglFramebuffer.length;j++)n.deleteFramebuffer(b.__webglFramebuffer[j]);else n.deleteFramebuffer(b.__webglFramebuffer);if(b.__webglDepthbuffer&&n.deleteRenderbuffer(b.__webglDepthbuffer),b.__webglMultisampledFramebuffer&&n.deleteFramebuffer(b.__webglMultisampledFramebuffer),b.__webglColorRenderbuffer)for(let j=0;j<b.__webglColorRenderbuffer.length;j++)b.__webglColorRenderbuffer[j]&&n.deleteRenderbuffer(b.__webglColorRenderbuffer[j]);b.__webglDepthRenderbuffer&&n.deleteRenderbuffer(b.__webglDepthRenderbuffer)}let te=E.textures;for(let j=0,ae=te.length;j<ae;j++){let ue=i.get(te[j]);ue.__webglTexture&&(n.deleteTexture(ue.__webglTexture),a.memory.textures--),i.remove(te[j])}i.remove(E)}let q=0;function Q(){q=0}function ee(){return q}function Ae(E){q=E}function Be(){let E=q;return E>=s.maxTextures&&Le("WebGLTextures: Trying to use "+(E+1)+" texture units while this GPU supports only "+s.maxTextures),q+=1,E}function $(E){let b=[];return b.push(E.wrapS),b.push(E.wrapT),b.push(E.wrapR||0),b.push(E.magFilter),b.push(E.minFilter),b.push(E.anisotropy),b.push(E.internalFormat),b.push(E.format),b.push(E.type),b.push(E.generateMipmaps),b.push(E.mipmapsAutoUpdate),b.push(E.premultiplyAlpha),b.push(E.flipY),b.push(E.unpackAlignment),b.push(E.colorSpace),b.join()}function _e(E,b){let O=i.get(E);if(E.isVideoTexture&&Ct(E),E.isRenderTargetTexture===!1&&E.isExternalTexture!==!0&&E.version>0&&O.__version!==E.version){let te=E.image;if(te===null)Le("WebGLRenderer: Texture marked for update but no image data found.");else if(te.complete===!1)Le("WebGLRenderer: Texture marked for update but image is incomplete");else{Rt(O,E,b);return}}else E.isExternalTexture&&(O.__webglTexture=E.sourceTexture?E.sourceTexture:null);t.bindTexture(n.TEXTURE_2D,O.__webglTexture,n.TEXTURE0+b)}function ye(E,b){let O=i.get(E);if(E.isRenderTargetTexture===!1&&E.version>0&&O.__version!==E.version){Rt(O,E,b);return}else E.isExternalTexture&&(O.__webglTexture=E.sourceTexture?E.sourceTexture:null);t.bindTexture(n.TEXTURE_2D_ARRAY,O.__webglTexture,n.TEXTURE0+b)}function Ie(E,b){let O=i.get(E);if(E.isRenderTargetTexture===!1&&E.version>0&&O.__version!==E.version){Rt(O,E,b);return}t.bindTexture(n.TEXTURE_3D,O.__webglTexture,n.TEXTURE0+b)}function be(E,b){let O=i.get(E);if(E.version>0&&O.__version!==E.version){en(O,E,b);return}t.bindTexture(n.TEXTURE_CUBE_MAP,O.__webglTexture,n.TEXTURE0+b)}let Ve={[wa]:n.REPEAT,[Fn]:n.CLAMP_TO_EDGE,[Sa]:n.MIRRORED_REPEAT},Mt={[St]:n.NEAREST,[Fu]:n.NEAREST_MIPMAP_NEAREST,[_r]:n.NEAREST_MIPMAP_LINEAR,[Jt]:n.LINEAR,[ja]:n.LINEAR_MIPMAP_NEAREST,[ri]:n.LINEAR_MIPMAP_LINEAR},Fe={[Bu]:n.NEVER,[cc]:n.ALWAYS,[zu]:n.LESS,[oc]:n.LEQUAL,[Gu]:n.EQUAL,[lc]:n.GEQUAL,[Vu]:n.GREATER,[Hu]:n.NOTEQUAL};function st(E,b){if(b.type===Tn&&e.has("OES_texture_float_linear")===!1&&(b.magFilter===Jt||b.magFilter===ja||b.magFilter===_r||b.magFilter===ri||b.minFilter===Jt||b.minFilter===ja||b.minFilter===_r||b.minFilter===ri)&&Le("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(E,n.TEXTURE_WRAP_S,Ve[b.wrapS]),n.texParameteri(E,n.TEXTURE_WRAP_T,Ve[b.wrapT]),(E===n.TEXTURE_3D||E===n.TEXTURE_2D_ARRAY)&&n.texParameteri(E,n.TEXTURE_WRAP_R,Ve[b.wrapR]),n.texParameteri(E,n.TEXTURE_MAG_FILTER,Mt[b.magFilter]),n.texParameteri(E,n.TEXTURE_MIN_FILTER,Mt[b.minFilter]),b.compareFunction&&(n.texParameteri(E,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(E,n.TEXTURE_COMPARE_FUNC,Fe[b.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(b.magFilter===St||b.minFilter!==_r&&b.minFilter!==ri||b.type===Tn&&e.has("OES_texture_float_linear")===!1)return;if(b.anisotropy>1||i.get(b).__currentAnisotropy){let O=e.get("EXT_texture_filter_anisotropic");n.texParameterf(E,O.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(b.anisotropy,s.getMaxAnisotropy())),i.get(b).__currentAnisotropy=b.anisotropy}}}function at(E,b){let O=!1;E.__webglInit===void 0&&(E.__webglInit=!0,b.addEventListener("dispose",N),U(b));let te=b.source,j=f.get(te);j===void 0&&(j={},f.set(te,j));let ae=$(b);if(ae!==E.__cacheKey){j[ae]===void 0&&(j[ae]={texture:n.createTexture(),usedTimes:0},a.memory.textures++,O=!0),j[ae].usedTimes++;let ue=j[E.__cacheKey];ue!==void 0&&(j[E.__cacheKey].usedTimes--,ue.usedTimes===0&&V(b)),E.__cacheKey=ae,E.__webglTexture=j[ae].texture}return O}function Ye(E,b,O){return Math.floor(Math.floor(E/O)/b)}function Ot(E,b,O,te){let ae=E.updateRanges;if(ae.length===0)t.texSubImage2D(n.TEXTURE_2D,0,0,0,b.width,b.height,O,te,b.data);else{ae.sort((C,J)=>C.start-J.start);let ue=0;for(let C=1;C<ae.length;C++){let J=ae[ue],X=ae[C],ce=J.start+J.count,re=Ye(X.start,b.width,4),oe=Ye(J.start,b.width,4);X.start<=ce+1&&re===oe&&Ye(X.start+X.count-1,b.width,4)===re?J.count=Math.max(J.count,X.start+X.count-J.start):(++ue,ae[ue]=X)}ae.length=ue+1;let Y=t.getParameter(n.UNPACK_ROW_LENGTH),Z=t.getParameter(n.UNPACK_SKIP_PIXELS),le=t.getParameter(n.UNPACK_SKIP_ROWS);t.pixelStorei(n.UNPACK_ROW_LENGTH,b.width);for(let C=0,J=ae.length;C<J;C++){let X=ae[C],ce=Math.floor(X.start/4),re=Math.ceil(X.count/4),oe=ce%b.width,Re=Math.floor(ce/b.width),We=re,se=1;t.pixelStorei(n.UNPACK_SKIP_PIXELS,oe),t.pixelStorei(n.UNPACK_SKIP_ROWS,Re),t.texSubImage2D(n.TEXTURE_2D,0,oe,Re,We,se,O,te,b.data)}E.clearUpdateRanges(),t.pixelStorei(n.UNPACK_ROW_LENGTH,Y),t.pixelStorei(n.UNPACK_SKIP_PIXELS,Z),t.pixelStorei(n.UNPACK_SKIP_ROWS,le)}}function Rt(E,b,O){let te=n.TEXTURE_2D;(b.isDataArrayTexture||b.isCompressedArrayTexture)&&(te=n.TEXTURE_2D_ARRAY),b.isData3DTexture&&(te=n.TEXTURE_3D);let j=at(E,b),ae=b.source;t.bindTexture(te,E.__webglTexture,n.TEXTURE0+O);let ue=i.get(ae);if(ae.version!==ue.__version||j===!0){if(t.activeTexture(n.TEXTURE0+O),(typeof ImageBitmap<"u"&&b.image instanceof ImageBitmap)===!1){let se=Je.getPrimaries(Je.workingColorSpace),Ce=b.colorSpace===oi?null:Je.getPrimaries(b.colorSpace),He=b.colorSpace===oi||se===Ce?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,b.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,He)}t.pixelStorei(n.UNPACK_ALIGNMENT,b.unpackAlignment);let Z=v(b.image,!1,s.maxTextureSize);Z=De(b,Z);let le=r.convert(b.format,b.colorSpace),C=r.convert(b.type),J=A(b.internalFormat,le,C,b.normalized,b.colorSpace,b.isVideoTexture);st(te,b);let X,ce=b.mipmaps,re=b.isVideoTexture!==!0,oe=ue.__version===void 0||j===!0,Re=ae.dataReady,We=M(b,Z);if(b.isDepthTexture)J=_(b.format===ai,b.type),oe&&(re?t.texStorage2D(n.TEXTURE_2D,1,J,Z.width,Z.height):t.texImage2D(n.TEXTURE_2D,0,J,Z.width,Z.height,0,le,C,null));else if(b.isDataTexture)if(ce.length>0){re&&oe&&t.texStorage2D(n.TEXTURE_2D,We,J,ce[0].width,ce[0].height);for(let se=0,Ce=ce.length;se<Ce;se++)X=ce[se],re?Re&&t.texSubImage2D(n.TEXTURE_2D,se,0,0,X.width,X.height,le,C,X.data):t.texImage2D(n.TEXTURE_2D,se,J,X.width,X.height,0,le,C,X.data);b.generateMipmaps=!1}else re?(oe&&t.texStorage2D(n.TEXTURE_2D,We,J,Z.width,Z.height),Re&&Ot(b,Z,le,C)):t.texImage2D(n.TEXTURE_2D,0,J,Z.width,Z.height,0,le,C,Z.data);else if(b.isCompressedTexture)if(b.isCompressedArrayTexture){re&&oe&&t.texStorage3D(n.TEXTURE_2D_ARRAY,We,J,ce[0].width,ce[0].height,Z.depth);for(let se=0,Ce=ce.length;se<Ce;se++)if(X=ce[se],b.format!==Rn)if(le!==null)if(re){if(Re)if(b.layerUpdates.size>0){let He=gc(X.width,X.height,b.format,b.type);for(let me of b.layerUpdates){let rt=X.data.subarray(me*He/X.data.BYTES_PER_ELEMENT,(me+1)*He/X.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,se,0,0,me,X.width,X.height,1,le,rt)}}else t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,se,0,0,0,X.width,X.height,Z.depth,le,X.data)}else t.compressedTexImage3D(n.TEXTURE_2D_ARRAY,se,J,X.width,X.height,Z.depth,0,X.data,0,0);else Le("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else re?Re&&t.texSubImage3D(n.TEXTURE_2D_ARRAY,se,0,0,0,X.width,X.height,Z.depth,le,C,X.data):t.texImage3D(n.TEXTURE_2D_ARRAY,se,J,X.width,X.height,Z.depth,0,le,C,X.data);b.layerUpdates.size>0&&b.clearLayerUpdates()}else{re&&oe&&t.texStorage2D(n.TEXTURE_2D,We,J,ce[0].width,ce[0].height);for(let se=0,Ce=ce.length;se<Ce;se++)X=ce[se],b.format!==Rn?le!==null?re?Re&&t.compressedTexSubImage2D(n.TEXTURE_2D,se,0,0,X.width,X.height,le,X.data):t.compressedTexImage2D(n.TEXTURE_2D,se,J,X.width,X.height,0,X.data):Le("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):re?Re&&t.texSubImage2D(n.TEXTURE_2D,se,0,0,X.width,X.height,le,C,X.data):t.texImage2D(n.TEXTURE_2D,se,J,X.width,X.height,0,le,C,X.data)}else if(b.isDataArrayTexture)if(re){if(oe&&t.texStorage3D(n.TEXTURE_2D_ARRAY,We,J,Z.width,Z.height,Z.depth),Re)if(b.layerUpdates.size>0){let se=gc(Z.width,Z.height,b.format,b.type);for(let Ce of b.layerUpdates){let He=Z.data.subarray(Ce*se/Z.data.BYTES_PER_ELEMENT,(Ce+1)*se/Z.data.BYTES_PER_ELEMENT);t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Ce,Z.width,Z.height,1,le,C,He)}b.clearLayerUpdates()}else t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Z.width,Z.height,Z.depth,le,C,Z.data)}else t.texImage3D(n.TEXTURE_2D_ARRAY,0,J,Z.width,Z.height,Z.depth,0,le,C,Z.data);else if(b.isData3DTexture)re?(oe&&t.texStorage3D(n.TEXTURE_3D,We,J,Z.width,Z.height,Z.depth),Re&&t.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Z.width,Z.height,Z.depth,le,C,Z.data)):t.texImage3D(n.TEXTURE_3D,0,J,Z.width,Z.height,Z.depth,0,le,C,Z.data);else if(b.isFramebufferTexture){if(oe)if(re)t.texStorage2D(n.TEXTURE_2D,We,J,Z.width,Z.height);else{let se=Z.width,Ce=Z.height;for(let He=0;He<We;He++)t.texImage2D(n.TEXTURE_2D,He,J,se,Ce,0,le,C,null),se>>=1,Ce>>=1}}else if(b.isHTMLTexture){if("texElementImage2D"in n){let se=n.canvas;if(se.hasAttribute("layoutsubtree")||se.setAttribute("layoutsubtree","true"),Z.parentNode!==se){se.appendChild(Z),d.add(b),se.onpaint=Ce=>{let He=Ce.changedElements;for(let me of d)He.includes(me.image)&&(me.needsUpdate=!0)},se.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Z);else{let He=n.RGBA,me=n.RGBA,rt=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,He,me,rt,Z)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(ce.length>0){if(re&&oe){let se=Oe(ce[0]);t.texStorage2D(n.TEXTURE_2D,We,J,se.width,se.height)}for(let se=0,Ce=ce.length;se<Ce;se++)X=ce[se],re?Re&&t.texSubImage2D(n.TEXTURE_2D,se,0,0,le,C,X):t.texImage2D(n.TEXTURE_2D,se,J,le,C,X);b.generateMipmaps=!1}else if(re){if(oe){let se=Oe(Z);t.texStorage2D(n.TEXTURE_2D,We,J,se.width,se.height)}Re&&t.texSubImage2D(n.TEXTURE_2D,0,0,0,le,C,Z)}else t.texImage2D(n.TEXTURE_2D,0,J,le,C,Z);S(b)&&b.mipmapsAutoUpdate===!0&&w(te),ue.__version=ae.version,b.onUpdate&&b.onUpdate(b)}E.__version=b.version}function en(E,b,O){if(b.image.length!==6)return;let te=at(E,b),j=b.source;t.bindTexture(n.TEXTURE_CUBE_MAP,E.__webglTexture,n.TEXTURE0+O);let ae=i.get(j);if(j.version!==ae.__version||te===!0){t.activeTexture(n.TEXTURE0+O);let ue=Je.getPrimaries(Je.workingColorSpace),Y=b.colorSpace===oi?null:Je.getPrimaries(b.colorSpace),Z=b.colorSpace===oi||ue===Y?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,b.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),t.pixelStorei(n.UNPACK_ALIGNMENT,b.unpackAlignment),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Z);let le=b.isCompressedTexture||b.image[0].isCompressedTexture,C=b.image[0]&&b.image[0].isDataTexture,J=[];for(let me=0;me<6;me++)!le&&!C?J[me]=v(b.image[me],!0,s.maxCubemapSize):J[me]=C?b.image[me].image:b.image[me],J[me]=De(b,J[me]);let X=J[0],ce=r.convert(b.format,b.colorSpace),re=r.convert(b.type),oe=A(b.internalFormat,ce,re,b.normalized,b.colorSpace),Re=b.isVideoTexture!==!0,We=ae.__version===void 0||te===!0,se=j.dataReady,Ce=M(b,X);st(n.TEXTURE_CUBE_MAP,b);let He;if(b.isDepthTexture){if(oe=_(b.format===ai,b.type),We)if(Re)t.texStorage2D(n.TEXTURE_CUBE_MAP,1,oe,X.width,X.height);else for(let me=0;me<6;me++)t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,oe,X.width,X.height,0,ce,re,null)}else if(le){Re&&We&&t.texStorage2D(n.TEXTURE_CUBE_MAP,Ce,oe,X.width,X.height);for(let me=0;me<6;me++){He=J[me].mipmaps;for(let rt=0;rt<He.length;rt++){let Nt=He[rt];b.format!==Rn?ce!==null?Re?se&&t.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt,0,0,Nt.width,Nt.height,ce,Nt.data):t.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt,oe,Nt.width,Nt.height,0,Nt.data):Le("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Re?se&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt,0,0,Nt.width,Nt.height,ce,re,Nt.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt,oe,Nt.width,Nt.height,0,ce,re,Nt.data)}}}else{if(He=b.mipmaps,Re&&We){He.length>0&&Ce++;let me=Oe(J[0]);t.texStorage2D(n.TEXTURE_CUBE_MAP,Ce,oe,me.width,me.height)}for(let me=0;me<6;me++)if(C){Re?se&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,0,0,J[me].width,J[me].height,ce,re,J[me].data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,oe,J[me].width,J[me].height,0,ce,re,J[me].data);for(let rt=0;rt<He.length;rt++){let ci=He[rt].image[me].image;Re?se&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt+1,0,0,ci.width,ci.height,ce,re,ci.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt+1,oe,ci.width,ci.height,0,ce,re,ci.data)}}else{Re?se&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,0,0,ce,re,J[me]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,oe,ce,re,J[me]);for(let rt=0;rt<He.length;rt++){let Nt=He[rt];Re?se&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt+1,0,0,ce,re,Nt.image[me]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,rt+1,oe,ce,re,Nt.image[me])}}}S(b)&&b.mipmapsAutoUpdate===!0&&w(n.TEXTURE_CUBE_MAP),ae.__version=j.version,b.onUpdate&&b.onUpdate(b)}E.__version=b.version}function vt(E,b,O,te,j,ae){let ue=r.convert(O.format,O.colorSpace),Y=r.convert(O.type),Z=A(O.internalFormat,ue,Y,O.normalized,O.colorSpace),le=i.get(b),C=i.get(O);if(C.__renderTarget=b,!le.__hasExternalTextures){let J=Math.max(1,b.width>>ae),X=Math.max(1,b.height>>ae);j===n.TEXTURE_3D||j===n.TEXTURE_2D_ARRAY?t.texImage3D(j,ae,Z,J,X,b.depth,0,ue,Y,null):t.texImage2D(j,ae,Z,J,X,0,ue,Y,null)}t.bindFramebuffer(n.FRAMEBUFFER,E),pe(b)?o.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,te,j,C.__webglTexture,0,gt(b)):(j===n.TEXTURE_2D||j>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&j<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,te,j,C.__webglTexture,ae),t.bindFramebuffer(n.FRAMEBUFFER,null)}function Pn(E,b,O){if(n.bindRenderbuffer(n.RENDERBUFFER,E),b.depthBuffer){let te=b.depthTexture,j=te&&te.isDepthTexture?te.type:null,ae=_(b.stencilBuffer,j),ue=b.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;pe(b)?o.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,gt(b),ae,b.width,b.height):O?n.renderbufferStorageMultisample(n.RENDERBUFFER,gt(b),ae,b.width,b.height):n.renderbufferStorage(n.RENDERBUFFER,ae,b.width,b.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,ue,n.RENDERBUFFER,E)}else{let te=b.textures;for(let j=0;j<te.length;j++){let ae=te[j],ue=r.convert(ae.format,ae.colorSpace),Y=r.convert(ae.type),Z=A(ae.internalFormat,ue,Y,ae.normalized,ae.colorSpace);pe(b)?o.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,gt(b),Z,b.width,b.height):O?n.renderbufferStorageMultisample(n.RENDERBUFFER,gt(b),Z,b.width,b.height):n.renderbufferStorage(n.RENDERBUFFER,Z,b.width,b.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Lt(E,b,O){let te=b.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(n.FRAMEBUFFER,E),!(b.depthTexture&&b.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let j=i.get(b.depthTexture);j.__renderTarget=b;let ae=te?b.depthTexture.image[0]:b.depthTexture.image;(!j.__webglTexture||ae.width!==b.width||ae.height!==b.height)&&(ae.width=b.width,ae.height=b.height,b.depthTexture.needsUpdate=!0),te?be(b.depthTexture,0):_e(b.depthTexture,0);let ue=j.__webglTexture,Y=gt(b),Z=te?n.TEXTURE_CUBE_MAP_POSITIVE_X+O:n.TEXTURE_2D,le=b.depthTexture.format===ai?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(b.depthTexture.format===ei)pe(b)?o.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,le,Z,ue,0,Y):n.framebufferTexture2D(n.FRAMEBUFFER,le,Z,ue,0);else if(b.depthTexture.format===ai)pe(b)?o.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,le,Z,ue,0,Y):n.framebufferTexture2D(n.FRAMEBUFFER,le,Z,ue,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function dn(E){let b=i.get(E),O=E.isWebGLCubeRenderTarget===!0;if(b.__boundDepthTexture!==E.depthTexture){let te=E.depthTexture;if(b.__depthDisposeCallback&&b.__depthDisposeCallback(),te){let j=()=>{delete b.__boundDepthTexture,delete b.__depthDisposeCallback,te.removeEventListener("dispose",j)};te.addEventListener("dispose",j),b.__depthDisposeCallback=j}b.__boundDepthTexture=te}if(E.depthTexture&&!b.__autoAllocateDepthBuffer)if(O)for(let te=0;te<6;te++)Lt(b.__webglFramebuffer[te],E,te);else E.texture.mipmaps.length>0?Lt(b.__webglFramebuffer[0],E,0):Lt(b.__webglFramebuffer,E,0);else if(O){b.__webglDepthbuffer=[];for(let te=0;te<6;te++)if(t.bindFramebuffer(n.FRAMEBUFFER,b.__webglFramebuffer[te]),b.__webglDepthbuffer[te]===void 0)b.__webglDepthbuffer[te]=n.createRenderbuffer(),Pn(b.__webglDepthbuffer[te],E,!1);else{let j=E.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ae=b.__webglDepthbuffer[te];n.bindRenderbuffer(n.RENDERBUFFER,ae),n.framebufferRenderbuffer(n.FRAMEBUFFER,j,n.RENDERBUFFER,ae)}}else if(E.texture.mipmaps.length>0?t.bindFramebuffer(n.FRAMEBUFFER,b.__webglFramebuffer[0]):t.bindFramebuffer(n.FRAMEBUFFER,b.__webglFramebuffer),b.__webglDepthbuffer===void 0)b.__webglDepthbuffer=n.createRenderbuffer(),Pn(b.__webglDepthbuffer,E,!1);else{let j=E.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ae=b.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,ae),n.framebufferRenderbuffer(n.FRAMEBUFFER,j,n.RENDERBUFFER,ae)}t.bindFramebuffer(n.FRAMEBUFFER,null)}function fn(E,b,O){let te=i.get(E);b!==void 0&&vt(te.__webglFramebuffer,E,E.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),O!==void 0&&dn(E)}function pn(E){let b=E.texture,O=i.get(E),te=i.get(b);E.addEventListener("dispose",B),U(E);let j=E.textures,ae=E.isWebGLCubeRenderTarget===!0,ue=j.length>1;if(ue||(te.__webglTexture===void 0&&(te.__webglTexture=n.createTexture()),te.__version=b.version,a.memory.textures++),ae){O.__webglFramebuffer=[];for(let Y=0;Y<6;Y++)if(b.mipmaps.length>0){O.__webglFramebuffer[Y]=[];for(let Z=0;Z<b.mipmaps.length;Z++)O.__webglFramebuffer[Y][Z]=n.createFramebuffer()}else O.__webglFramebuffer[Y]=n.createFramebuffer()}else{if(b.mipmaps.length>0){O.__webglFramebuffer=[];for(let Y=0;Y<b.mipmaps.length;Y++)O.__webglFramebuffer[Y]=n.createFramebuffer()}else O.__webglFramebuffer=n.createFramebuffer();if(ue)for(let Y=0,Z=j.length;Y<Z;Y++){let le=i.get(j[Y]);le.__webglTexture===void 0&&(le.__webglTexture=n.createTexture(),a.memory.textures++)}if(E.samples>0&&pe(E)===!1){O.__webglMultisampledFramebuffer=n.createFramebuffer(),O.__webglColorRenderbuffer=[],t.bindFramebuffer(n.FRAMEBUFFER,O.__webglMultisampledFramebuffer);for(let Y=0;Y<j.length;Y++){let Z=j[Y];O.__webglColorRenderbuffer[Y]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,O.__webglColorRenderbuffer[Y]);let le=r.convert(Z.format,Z.colorSpace),C=r.convert(Z.type),J=A(Z.internalFormat,le,C,Z.normalized,Z.colorSpace,E.isXRRenderTarget===!0),X=gt(E);n.renderbufferStorageMultisample(n.RENDERBUFFER,X,J,E.width,E.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+Y,n.RENDERBUFFER,O.__webglColorRenderbuffer[Y])}n.bindRenderbuffer(n.RENDERBUFFER,null),E.depthBuffer&&(O.__webglDepthRenderbuffer=n.createRenderbuffer(),Pn(O.__webglDepthRenderbuffer,E,!0)),t.bindFramebuffer(n.FRAMEBUFFER,null)}}if(ae){t.bindTexture(n.TEXTURE_CUBE_MAP,te.__webglTexture),st(n.TEXTURE_CUBE_MAP,b);for(let Y=0;Y<6;Y++)if(b.mipmaps.length>0)for(let Z=0;Z<b.mipmaps.length;Z++)vt(O.__webglFramebuffer[Y][Z],E,b,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+Y,Z);else vt(O.__webglFramebuffer[Y],E,b,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+Y,0);S(b)?w(n.TEXTURE_CUBE_MAP):b.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),t.unbindTexture()}else if(ue){for(let Y=0,Z=j.length;Y<Z;Y++){let le=j[Y],C=i.get(le),J=n.TEXTURE_2D;(E.isWebGL3DRenderTarget||E.isWebGLArrayRenderTarget)&&(J=E.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(J,C.__webglTexture),st(J,le),vt(O.__webglFramebuffer,E,le,n.COLOR_ATTACHMENT0+Y,J,0),S(le)&&w(J)}t.unbindTexture()}else{let Y=n.TEXTURE_2D;if((E.isWebGL3DRenderTarget||E.isWebGLArrayRenderTarget)&&(Y=E.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(Y,te.__webglTexture),st(Y,b),b.mipmaps.length>0)for(let Z=0;Z<b.mipmaps.length;Z++)vt(O.__webglFramebuffer[Z],E,b,n.COLOR_ATTACHMENT0,Y,Z);else vt(O.__webglFramebuffer,E,b,n.COLOR_ATTACHMENT0,Y,0);S(b)?w(Y):b.mipmaps.length>0&&n.texParameteri(Y,n.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),t.unbindTexture()}E.depthBuffer&&dn(E)}function L(E){let b=E.textures;for(let O=0,te=b.length;O<te;O++){let j=b[O];if(S(j)&&j.mipmapsAutoUpdate===!0){let ae=T(E),ue=i.get(j).__webglTexture;t.bindTexture(ae,ue),w(ae),t.unbindTexture()}}}let mn=[];function mt(E){if(E.samples>0){if(pe(E)===!1){let b=E.textures,O=E.width,te=E.height,j=n.COLOR_BUFFER_BIT,ae=E.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ue=i.get(E),Y=b.length>1;if(Y)for(let le=0;le<b.length;le++)t.bindFramebuffer(n.FRAMEBUFFER,ue.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+le,n.RENDERBUFFER,null),t.bindFramebuffer(n.FRAMEBUFFER,ue.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+le,n.TEXTURE_2D,null,0);t.bindFramebuffer(n.READ_FRAMEBUFFER,ue.__webglMultisampledFramebuffer),E.texture.mipmaps.length>0?t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ue.__webglFramebuffer[0]):t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ue.__webglFramebuffer);for(let le=0;le<b.length;le++){if(E.resolveDepthBuffer&&(E.depthBuffer&&(j|=n.DEPTH_BUFFER_BIT),E.stencilBuffer&&E.resolveStencilBuffer&&(j|=n.STENCIL_BUFFER_BIT)),Y){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,ue.__webglColorRenderbuffer[le]);let C=i.get(b[le]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,C,0)}n.blitFramebuffer(0,0,O,te,0,0,O,te,j,n.NEAREST),c===!0&&(mn.length=0,mn.push(n.COLOR_ATTACHMENT0+le),E.depthBuffer&&E.storeMultisampledDepthBuffer===!1&&mn.push(ae),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,mn))}if(t.bindFramebuffer(n.READ_FRAMEBUFFER,null),t.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),Y)for(let le=0;le<b.length;le++){t.bindFramebuffer(n.FRAMEBUFFER,ue.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+le,n.RENDERBUFFER,ue.__webglColorRenderbuffer[le]);let C=i.get(b[le]).__webglTexture;t.bindFramebuffer(n.FRAMEBUFFER,ue.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+le,n.TEXTURE_2D,C,0)}t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ue.__webglMultisampledFramebuffer)}else if(E.depthBuffer&&E.storeMultisampledDepthBuffer===!1&&c){let b=E.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[b])}}}function gt(E){return Math.min(s.maxSamples,E.samples)}function pe(E){let b=i.get(E);return E.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&b.__useRenderToTexture!==!1}function Ct(E){let b=a.render.frame;u.get(E)!==b&&(u.set(E,b),E.update())}function De(E,b){let O=E.colorSpace,te=E.format,j=E.type;return E.isCompressedTexture===!0||E.isVideoTexture===!0||O!==$s&&O!==oi&&(Je.getTransfer(O)===it?(te!==Rn||j!==rn)&&Le("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Ue("WebGLTextures: Unsupported texture color space:",O)),b}function Oe(E){return typeof HTMLImageElement<"u"&&E instanceof HTMLImageElement?(l.width=E.naturalWidth||E.width,l.height=E.naturalHeight||E.height):typeof VideoFrame<"u"&&E instanceof VideoFrame?(l.width=E.displayWidth,l.height=E.displayHeight):(l.width=E.width,l.height=E.height),l}this.allocateTextureUnit=Be,this.resetTextureUnits=Q,this.getTextureUnits=ee,this.setTextureUnits=Ae,this.setTexture2D=_e,this.setTexture2DArray=ye,this.setTexture3D=Ie,this.setTextureCube=be,this.rebindTextures=fn,this.setupRenderTarget=pn,this.updateRenderTargetMipmap=L,this.updateMultisampleRenderTarget=mt,this.setupDepthRenderbuffer=dn,this.setupFrameBufferTexture=vt,this.useMultisampledRTT=pe,this.dispose=H}function zb(n,e){function t(i,s=oi){let r,a=Je.getTransfer(s);if(i===rn)return n.UNSIGNED_BYTE;if(i===eo)return n.UNSIGNED_SHORT_4_4_4_4;if(i===to)return n.UNSIGNED_SHORT_5_5_5_1;if(i===nc)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===ic)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===ec)return n.BYTE;if(i===tc)return n.SHORT;if(i===Rs)return n.UNSIGNED_SHORT;if(i===Qa)return n.INT;if(i===An)return n.UNSIGNED_INT;if(i===Tn)return n.FLOAT;if(i===En)return n.HALF_FLOAT;if(i===sc)return n.ALPHA;if(i===rc)return n.RGB;if(i===Rn)return n.RGBA;if(i===ei)return n.DEPTH_COMPONENT;if(i===ai)return n.DEPTH_STENCIL;if(i===ac)return n.RED;if(i===no)return n.RED_INTEGER;if(i===Ei)return n.RG;if(i===io)return n.RG_INTEGER;if(i===so)return n.RGBA_INTEGER;if(i===br||i===xr||i===vr||i===yr)if(a===it)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===br)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===xr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===vr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===yr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===br)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===xr)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===vr)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===yr)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===ro||i===ao||i===oo||i===lo)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===ro)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===ao)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===oo)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===lo)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===co||i===ho||i===uo||i===fo||i===po||i===wr||i===mo)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(i===co||i===ho)return a===it?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===uo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===fo)return r.COMPRESSED_R11_EAC;if(i===po)return r.COMPRESSED_SIGNED_R11_EAC;if(i===wr)return r.COMPRESSED_RG11_EAC;if(i===mo)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===go||i===_o||i===bo||i===xo||i===vo||i===yo||i===wo||i===So||i===Mo||i===Ao||i===To||i===Eo||i===Ro||i===Co)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(i===go)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===_o)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===bo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===xo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===vo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===yo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===wo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===So)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Mo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Ao)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===To)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Eo)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Ro)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Co)return a===it?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Po||i===Io||i===Do)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(i===Po)return a===it?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Io)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Do)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Lo||i===No||i===Sr||i===Fo)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(i===Lo)return r.COMPRESSED_RED_RGTC1_EXT;if(i===No)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Sr)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Fo)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Zi?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:t}}var Gb=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Vb=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Ac=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let i=new cr(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=i}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,i=new On({vertexShader:Gb,fragmentShader:Vb,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Et(new Xi(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Tc=class extends kn{constructor(e,t){super();let i=this,s=null,r=1,a=null,o="local-floor",c=1,l=null,u=null,d=null,h=null,f=null,g=null,x=typeof XRWebGLBinding<"u",m=new Ac,p={},v=t.getContextAttributes(),S=null,w=null,T=[],A=[],_=new je,M=null,U=null,D=new $t;D.viewport=new xt;let N=new $t;N.viewport=new xt;let B=[D,N],W=new Ya,P=null,H=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function($){let _e=T[$];return _e===void 0&&(_e=new ys,T[$]=_e),_e.getTargetRaySpace()},this.getControllerGrip=function($){let _e=T[$];return _e===void 0&&(_e=new ys,T[$]=_e),_e.getGripSpace()},this.getHand=function($){let _e=T[$];return _e===void 0&&(_e=new ys,T[$]=_e),_e.getHandSpace()};function K($){let _e=A.indexOf($.inputSource);if(_e===-1)return;let ye=T[_e];ye!==void 0&&(ye.update($.inputSource,$.frame,l||a),ye.dispatchEvent({type:$.type,data:$.inputSource}))}function V(){s.removeEventListener("select",K),s.removeEventListener("selectstart",K),s.removeEventListener("selectend",K),s.removeEventListener("squeeze",K),s.removeEventListener("squeezestart",K),s.removeEventListener("squeezeend",K),s.removeEventListener("end",V),s.removeEventListener("inputsourceschange",ie);for(let $=0;$<T.length;$++){let _e=A[$];_e!==null&&(A[$]=null,T[$].disconnect(_e))}P=null,H=null,m.reset();for(let $ in p)delete p[$];if(e.setRenderTarget(S),f=null,h=null,d=null,s=null,w=null,Be.stop(),i.isPresenting=!1,e.setPixelRatio(M),e.setSize(_.width,_.height,!1),U!==null){let $=U.camera;$.fov=U.fov,$.zoom=U.zoom,$.updateProjectionMatrix(),U=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function($){r=$,i.isPresenting===!0&&Le("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function($){o=$,i.isPresenting===!0&&Le("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return l||a},this.setReferenceSpace=function($){l=$},this.getBaseLayer=function(){return h!==null?h:f},this.getBinding=function(){return d===null&&x&&(d=new XRWebGLBinding(s,t)),d},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function($){if(s=$,s!==null){if(S=e.getRenderTarget(),s.addEventListener("select",K),s.addEventListener("selectstart",K),s.addEventListener("selectend",K),s.addEventListener("squeeze",K),s.addEventListener("squeezestart",K),s.addEventListener("squeezeend",K),s.addEventListener("end",V),s.addEventListener("inputsourceschange",ie),v.xrCompatible!==!0&&await t.makeXRCompatible(),M=e.getPixelRatio(),e.getSize(_),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let ye=null,Ie=null,be=null;v.depth&&(be=v.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ye=v.stencil?ai:ei,Ie=v.stencil?Zi:An);let Ve={colorFormat:t.RGBA8,depthFormat:be,scaleFactor:r};d=this.getBinding(),h=d.createProjectionLayer(Ve),s.updateRenderState({layers:[h]}),e.setPixelRatio(1),e.setSize(h.textureWidth,h.textureHeight,!1),w=new hn(h.textureWidth,h.textureHeight,{format:Rn,type:rn,depthTexture:new ii(h.textureWidth,h.textureHeight,Ie,void 0,void 0,void 0,void 0,void 0,void 0,ye),stencilBuffer:v.stencil,colorSpace:e.outputColorSpace,samples:v.antialias?4:0,resolveDepthBuffer:h.ignoreDepthValues===!1,resolveStencilBuffer:h.ignoreDepthValues===!1,storeMultisampledDepthBuffer:h.ignoreDepthValues===!1,storeMultisampledStencilBuffer:h.ignoreDepthValues===!1})}else{let ye={antialias:v.antialias,alpha:!0,depth:v.depth,stencil:v.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ye),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),w=new hn(f.framebufferWidth,f.framebufferHeight,{format:Rn,type:rn,colorSpace:e.outputColorSpace,stencilBuffer:v.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}w.isXRRenderTarget=!0,this.setFoveation(c),l=null,a=await s.requestReferenceSpace(o),Be.setContext(s),Be.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function ie($){for(let _e=0;_e<$.removed.length;_e++){let ye=$.removed[_e],Ie=A.indexOf(ye);Ie>=0&&(A[Ie]=null,T[Ie].disconnect(ye))}for(let _e=0;_e<$.added.length;_e++){let ye=$.added[_e],Ie=A.indexOf(ye);if(Ie===-1){for(let Ve=0;Ve<T.length;Ve++)if(Ve>=A.length){A.push(ye),Ie=Ve;break}else if(A[Ve]===null){A[Ve]=ye,Ie=Ve;break}if(Ie===-1)break}let be=T[Ie];be&&be.connect(ye)}}function q($,_e){_e===null?$.matrixWorld.copy($.matrix):$.matrixWorld.multiplyMatrices(_e.matrixWorld,$.matrix),$.matrixWorldInverse.copy($.matrixWorld).invert()}this.updateCamera=function($){if(s===null)return;let _e=$.near,ye=$.far;m.texture!==null&&(m.depthNear>0&&(_e=m.depthNear),m.depthFar>0&&(ye=m.depthFar)),W.near=N.near=D.near=_e,W.far=N.far=D.far=ye,(P!==W.near||H!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),P=W.near,H=W.far),W.layers.mask=$.layers.mask|6,D.layers.mask=W.layers.mask&-5,N.layers.mask=W.layers.mask&-3;let Ie=$.parent,be=W.cameras;q(W,Ie);for(let Ve=0;Ve<be.length;Ve++)q(be[Ve],Ie);W.projectionMatrix.copy(D.projectionMatrix),W.projectionMatrixInverse.copy(D.projectionMatrixInverse),U===null&&$.isPerspectiveCamera&&(U={camera:$,fov:$.fov,zoom:$.zoom}),Q($,W,Ie)};function Q($,_e,ye){ye===null?$.matrix.copy(_e.matrixWorld):($.matrix.copy(ye.matrixWorld),$.matrix.invert(),$.matrix.multiply(_e.matrixWorld)),$.matrix.decompose($.position,$.quaternion,$.scale),$.updateMatrixWorld(!0),$.projectionMatrix.copy(_e.projectionMatrix),$.projectionMatrixInverse.copy(_e.projectionMatrixInverse),$.isPerspectiveCamera&&($.fov=Aa*2*Math.atan(1/$.projectionMatrix.elements[5]),$.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(h===null&&f===null))return c},this.setFoveation=function($){c=$,h!==null&&(h.fixedFoveation=$),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=$)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(W)},this.getCameraTexture=function($){return p[$]};let ee=null;function Ae($,_e){if(u=_e.getViewerPose(l||a),g=_e,u!==null){let ye=u.views;f!==null&&(e.setRenderTargetFramebuffer(w,f.framebuffer),e.setRenderTarget(w));let Ie=!1;ye.length!==W.cameras.length&&(W.cameras.length=0,Ie=!0);for(let Fe=0;Fe<ye.length;Fe++){let st=ye[Fe],at=null;if(f!==null)at=f.getViewport(st);else{let Ot=d.getViewSubImage(h,st);at=Ot.viewport,Fe===0&&(e.setRenderTargetTextures(w,Ot.colorTexture,Ot.depthStencilTexture),e.setRenderTarget(w))}let Ye=B[Fe];Ye===void 0&&(Ye=new $t,Ye.layers.enable(Fe),Ye.viewport=new xt,B[Fe]=Ye),Ye.matrix.fromArray(st.transform.matrix),Ye.matrix.decompose(Ye.position,Ye.quaternion,Ye.scale),Ye.projectionMatrix.fromArray(st.projectionMatrix),Ye.projectionMatrixInverse.copy(Ye.projectionMatrix).invert(),Ye.viewport.set(at.x,at.y,at.width,at.height),Fe===0&&(W.matrix.copy(Ye.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Ie===!0&&W.cameras.push(Ye)}let be=s.enabledFeatures;if(be&&be.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&x){d=i.getBinding();let Fe=d.getDepthInformation(ye[0]);Fe&&Fe.isValid&&Fe.texture&&m.init(Fe,s.renderState)}if(be&&be.includes("camera-access")&&x){e.state.unbindTexture(),d=i.getBinding();for(let Fe=0;Fe<ye.length;Fe++){let st=ye[Fe].camera;if(st){let at=p[st];at||(at=new cr,p[st]=at);let Ye=d.getCameraImage(st);at.sourceTexture=Ye}}}}for(let ye=0;ye<T.length;ye++){let Ie=A[ye],be=T[ye];Ie!==null&&be!==void 0&&be.update(Ie,_e,l||a)}ee&&ee($,_e),_e.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:_e}),g=null}let Be=new yd;Be.setAnimationLoop(Ae),this.setAnimationLoop=function($){ee=$},this.dispose=function(){}}},Hb=new ct,Id=new ke;Id.set(-1,0,0,0,1,0,0,0,1);function Wb(n,e){function t(m,p){m.matrixAutoUpdate===!0&&m.updateMatrix(),p.value.copy(m.matrix)}function i(m,p){p.color.getRGB(m.fogColor.value,fc(n)),p.isFog?(m.fogNear.value=p.near,m.fogFar.value=p.far):p.isFogExp2&&(m.fogDensity.value=p.density)}function s(m,p,v,S,w){p.isNodeMaterial?p.uniformsNeedUpdate=!1:p.isMeshBasicMaterial?r(m,p):p.isMeshLambertMaterial?(r(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshToonMaterial?(r(m,p),d(m,p)):p.isMeshPhongMaterial?(r(m,p),u(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshStandardMaterial?(r(m,p),h(m,p),p.isMeshPhysicalMaterial&&f(m,p,w)):p.isMeshMatcapMaterial?(r(m,p),g(m,p)):p.isMeshDepthMaterial?r(m,p):p.isMeshDistanceMaterial?(r(m,p),x(m,p)):p.isMeshNormalMaterial?r(m,p):p.isLineBasicMaterial?(a(m,p),p.isLineDashedMaterial&&o(m,p)):p.isPointsMaterial?c(m,p,v,S):p.isSpriteMaterial?l(m,p):p.isShadowMaterial?(m.color.value.copy(p.color),m.opacity.value=p.opacity):p.isShaderMaterial&&(p.uniformsNeedUpdate=!1)}function r(m,p){m.opacity.value=p.opacity,p.color&&m.diffuse.value.copy(p.color),p.emissive&&m.emissive.value.copy(p.emissive).multiplyScalar(p.emissiveIntensity),p.map&&(m.map.value=p.map,t(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.bumpMap&&(m.bumpMap.value=p.bumpMap,t(p.bumpMap,m.bumpMapTransform),m.bumpScale.value=p.bumpScale,p.side===Qt&&(m.bumpScale.value*=-1)),p.normalMap&&(m.normalMap.value=p.normalMap,t(p.normalMap,m.normalMapTransform),m.normalScale.value.copy(p.normalScale),p.side===Qt&&m.normalScale.value.negate()),p.displacementMap&&(m.displacementMap.value=p.displacementMap,t(p.displacementMap,m.displacementMapTransform),m.displacementScale.value=p.displacementScale,m.displacementBias.value=p.displacementBias),p.emissiveMap&&(m.emissiveMap.value=p.emissiveMap,t(p.emissiveMap,m.emissiveMapTransform)),p.specularMap&&(m.specularMap.value=p.specularMap,t(p.specularMap,m.specularMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest);let v=e.get(p),S=v.envMap,w=v.envMapRotation;S&&(m.envMap.value=S,m.envMapRotation.value.setFromMatrix4(Hb.makeRotationFromEuler(w)).transpose(),S.isCubeTexture&&S.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(Id),m.reflectivity.value=p.reflectivity,m.ior.value=p.ior,m.refractionRatio.value=p.refractionRatio),p.lightMap&&(m.lightMap.value=p.lightMap,m.lightMapIntensity.value=p.lightMapIntensity,t(p.lightMap,m.lightMapTransform)),p.aoMap&&(m.aoMap.value=p.aoMap,m.aoMapIntensity.value=p.aoMapIntensity,t(p.aoMap,m.aoMapTransform))}function a(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,p.map&&(m.map.value=p.map,t(p.map,m.mapTransform))}function o(m,p){m.dashSize.value=p.dashSize,m.totalSize.value=p.dashSize+p.gapSize,m.scale.value=p.scale}function c(m,p,v,S){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.size.value=p.size*v,m.scale.value=S*.5,p.map&&(m.map.value=p.map,t(p.map,m.uvTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function l(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.rotation.value=p.rotation,p.map&&(m.map.value=p.map,t(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function u(m,p){m.specular.value.copy(p.specular),m.shininess.value=Math.max(p.shininess,1e-4)}function d(m,p){p.gradientMap&&(m.gradientMap.value=p.gradientMap)}function h(m,p){m.metalness.value=p.metalness,p.metalnessMap&&(m.metalnessMap.value=p.metalnessMap,t(p.metalnessMap,m.metalnessMapTransform)),m.roughness.value=p.roughness,p.roughnessMap&&(m.roughnessMap.value=p.roughnessMap,t(p.roughnessMap,m.roughnessMapTransform)),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)}function f(m,p,v){m.ior.value=p.ior,p.diffuseRoughness>0&&(m.diffuseRoughness.value=p.diffuseRoughness,p.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=p.diffuseRoughnessMap,t(p.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),p.sheen>0&&(m.sheenColor.value.copy(p.sheenColor).multiplyScalar(p.sheen),m.sheenRoughness.value=p.sheenRoughness,p.sheenColorMap&&(m.sheenColorMap.value=p.sheenColorMap,t(p.sheenColorMap,m.sheenColorMapTransform)),p.sheenRoughnessMap&&(m.sheenRoughnessMap.value=p.sheenRoughnessMap,t(p.sheenRoughnessMap,m.sheenRoughnessMapTransform))),p.clearcoat>0&&(m.clearcoat.value=p.clearcoat,m.clearcoatRoughness.value=p.clearcoatRoughness,p.clearcoatMap&&(m.clearcoatMap.value=p.clearcoatMap,t(p.clearcoatMap,m.clearcoatMapTransform)),p.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=p.clearcoatRoughnessMap,t(p.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),p.clearcoatNormalMap&&(m.clearcoatNormalMap.value=p.clearcoatNormalMap,t(p.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(p.clearcoatNormalScale),p.side===Qt&&m.clearcoatNormalScale.value.negate())),p.dispersion>0&&(m.dispersion.value=p.dispersion),p.retroreflectivity>0&&(m.retroreflectivity.value=p.retroreflectivity),p.iridescence>0&&(m.iridescence.value=p.iridescence,m.iridescenceIOR.value=p.iridescenceIOR,m.iridescenceThicknessMinimum.value=p.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=p.iridescenceThicknessMaximum,p.iridescenceMap&&(m.iridescenceMap.value=p.iridescenceMap,t(p.iridescenceMap,m.iridescenceMapTransform)),p.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=p.iridescenceThicknessMap,t(p.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),p.transmission>0&&(m.transmission.value=p.transmission,m.transmissionSamplerMap.value=v.texture,m.transmissionSamplerSize.value.set(v.width,v.height),p.transmissionMap&&(m.transmissionMap.value=p.transmissionMap,t(p.transmissionMap,m.transmissionMapTransform)),m.thickness.value=p.thickness,p.thicknessMap&&(m.thicknessMap.value=p.thicknessMap,t(p.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=p.attenuationDistance,m.attenuationColor.value.copy(p.attenuationColor)),p.anisotropy>0&&(m.anisotropyVector.value.set(p.anisotropy*Math.cos(p.anisotropyRotation),p.anisotropy*Math.sin(p.anisotropyRotation)),p.anisotropyMap&&(m.anisotropyMap.value=p.anisotropyMap,t(p.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=p.specularIntensity,m.specularColor.value.copy(p.specularColor),p.specularColorMap&&(m.specularColorMap.value=p.specularColorMap,t(p.specularColorMap,m.specularColorMapTransform)),p.specularIntensityMap&&(m.specularIntensityMap.value=p.specularIntensityMap,t(p.specularIntensityMap,m.specularIntensityMapTransform))}function g(m,p){p.matcap&&(m.matcap.value=p.matcap)}function x(m,p){let v=e.get(p).light;m.referencePosition.value.setFromMatrixPosition(v.matrixWorld),m.nearDistance.value=v.shadow.camera.near,m.farDistance.value=v.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function Xb(n,e,t,i){let s={},r={};function a(v,S){let w=S.program;i.uniformBlockBinding(v,w,s[v.id])}function o(v,S){let w=s[v.id];w===void 0&&(g(v),w=c(v),s[v.id]=w,v.addEventListener("dispose",m));let T=S.program;i.updateUBOMapping(v,T);let A=e.render.frame;r[v.id]!==A&&(l(v),r[v.id]=A)}function c(v){let S=n.createBuffer(),w=v.__size,T=v.usage;return n.bindBuffer(n.UNIFORM_BUFFER,S),n.bufferData(n.UNIFORM_BUFFER,w,T),n.bindBuffer(n.UNIFORM_BUFFER,null),S}function l(v){let S=s[v.id],w=v.uniforms,T=v.__cache;n.bindBuffer(n.UNIFORM_BUFFER,S);for(let A=0,_=w.length;A<_;A++){let M=w[A];if(Array.isArray(M))for(let U=0,D=M.length;U<D;U++)u(M[U],A,U,T);else u(M,A,0,T)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function u(v,S,w,T){if(h(v,S,w,T)===!0){let A=v.__offset,_=v.value;if(Array.isArray(_)){let M=0;for(let U=0;U<_.length;U++){let D=_[U],N=x(D,!0);d(D,v.__data,M),M+=N.storage/Float32Array.BYTES_PER_ELEMENT}}else d(_,v.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,A,v.__data)}}function d(v,S,w){typeof v=="number"||typeof v=="boolean"?S[w]=v:v.isMatrix3?(S[w]=v.elements[0],S[w+1]=v.elements[1],S[w+2]=v.elements[2],S[w+3]=0,S[w+4]=v.elements[3],S[w+5]=v.elements[4],S[w+6]=v.elements[5],S[w+7]=0,S[w+8]=v.elements[6],S[w+9]=v.elements[7],S[w+10]=v.elements[8],S[w+11]=0):ArrayBuffer.isView(v)?S.set(v.subarray(0,S.length-w),w):v.toArray(S,w)}function h(v,S,w,T){let A=v.value,_=S+"_"+w;if(Array.isArray(A)){T[_]===void 0&&(T[_]=[]);let M=T[_],U=!1;for(let D=0;D<A.length;D++)f(A[D],M,D)===!0&&(U=!0);return U}return f(A,T,_)}function f(v,S,w){if(S[w]===void 0)return typeof v=="number"||typeof v=="boolean"?S[w]=v:ArrayBuffer.isView(v)?S[w]=v.slice():S[w]=v.clone(),!0;{let T=S[w];if(typeof v=="number"||typeof v=="boolean"){if(T!==v)return S[w]=v,!0}else{if(ArrayBuffer.isView(v))return!0;if(T.equals(v)===!1)return T.copy(v),!0}}return!1}function g(v){let S=v.uniforms,w=0,T=16;for(let _=0,M=S.length;_<M;_++){let U=Array.isArray(S[_])?S[_]:[S[_]];for(let D=0,N=U.length;D<N;D++){let B=U[D],W=Array.isArray(B.value)?B.value:[B.value],P=Array.isArray(S[_])||Array.isArray(B.value),H=w;for(let V=0,ie=W.length;V<ie;V++){let q=W[V],Q=x(q,P),ee=w%T,Ae=ee%Q.boundary,Be=ee+Ae;w+=Ae,Be!==0&&T-Be<Q.storage&&(w+=T-Be),V===0&&(H=w),w+=Q.storage}let K=B.type==="int"?Int32Array:B.type==="uint"?Uint32Array:Float32Array;B.__data=new K((w-H)/Float32Array.BYTES_PER_ELEMENT),B.__offset=H}}let A=w%T;return A>0&&(w+=T-A),v.__size=w,v.__cache={},this}function x(v,S){let w={boundary:0,storage:0};return typeof v=="number"||typeof v=="boolean"?(w.boundary=4,w.storage=4):v.isVector2?(w.boundary=8,w.storage=8):v.isVector3||v.isColor?(w.boundary=16,w.storage=12):v.isVector4?(w.boundary=16,w.storage=16):v.isMatrix3?(w.boundary=16,w.storage=48):v.isMatrix4?(w.boundary=16,w.storage=64):v.isTexture?Le("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(v)?(w.boundary=16,w.storage=v.byteLength):Le("WebGLRenderer: Unsupported uniform value type.",v),S===!0&&(w.boundary=16,w.storage=Math.ceil(w.storage/16)*16),w}function m(v){let S=v.target;S.removeEventListener("dispose",m),n.deleteBuffer(s[S.id]),delete s[S.id],delete r[S.id]}function p(){for(let v in s)n.deleteBuffer(s[v]);s={},r={}}return{bind:a,update:o,dispose:p}}var qb=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),zn=null;function Kb(){return zn===null&&(zn=new Ca(qb,16,16,Ei,En),zn.name="DFG_LUT",zn.minFilter=Jt,zn.magFilter=Jt,zn.wrapS=Fn,zn.wrapT=Fn,zn.generateMipmaps=!1,zn.needsUpdate=!0),zn}var zo=class{constructor(e={}){let{canvas:t=Xu(),context:i=null,depth:s=!0,stencil:r=!1,alpha:a=!1,antialias:o=!1,premultipliedAlpha:c=!0,preserveDrawingBuffer:l=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:d=!1,reversedDepthBuffer:h=!1,outputBufferType:f=rn}=e;this.isWebGLRenderer=!0;let g;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=i.getContextAttributes().alpha}else g=a;let x=f,m=new Set([so,io,no]),p=new Set([rn,An,Rs,Zi,eo,to]),v=new Uint32Array(4),S=new Int32Array(4),w={textures:[],min:[],max:[],resolution:[]},T=null,A=null,_=[],M=[],U=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Bn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let D=this,N=!1,B=null,W=null,P=null,H=null;this._outputColorSpace=Zt;let K=0,V=0,ie=null,q=-1,Q=null,ee=new xt,Ae=new xt,Be=null,$=new Xe(0),_e=0,ye=t.width,Ie=t.height,be=1,Ve=null,Mt=null,Fe=new xt(0,0,ye,Ie),st=new xt(0,0,ye,Ie),at=!1,Ye=new vi,Ot=new Pa,Rt=!1,en=!1,vt=new ct,Pn=new F,Lt=new xt,dn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},fn=!1;function pn(){return ie===null?be:1}let L=i;function mn(y,I){return t.getContext(y,I)}let mt,gt,pe,Ct,De,Oe,E,b,O,te,j,ae,ue,Y,Z,le,C,J,X,ce,re,oe,Re;try{let y={alpha:!0,depth:s,stencil:r,antialias:o,premultipliedAlpha:c,preserveDrawingBuffer:l,powerPreference:u,failIfMajorPerformanceCaveat:d};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Ce,!1),t.addEventListener("webglcontextrestored",He,!1),t.addEventListener("webglcontextcreationerror",me,!1),L===null){let I="webgl2";if(L=mn(I,y),L===null)throw mn(I)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}We()}catch(y){throw t.removeEventListener("webglcontextlost",Ce,!1),t.removeEventListener("webglcontextrestored",He,!1),t.removeEventListener("webglcontextcreationerror",me,!1),Ue("WebGLRenderer: "+y.message),y}function We(){mt=new s0(L),mt.init(),re=new zb(L,mt),gt=new K_(L,mt,e,re),pe=new Ob(L,mt),gt.reversedDepthBuffer&&h&&pe.buffers.depth.setReversed(!0),W=L.createFramebuffer(),P=L.createFramebuffer(),H=L.createFramebuffer(),Ct=new o0(L),De=new Mb,Oe=new Bb(L,mt,pe,De,gt,re,Ct),E=new i0(D),b=new cm(L),oe=new X_(L,b),O=new r0(L,b,Ct,oe),te=new c0(L,O,b,oe,Ct),J=new l0(L,gt,Oe),Z=new Y_(De),j=new Sb(D,E,mt,gt,oe,Z),ae=new Wb(D,De),ue=new Tb,Y=new Db(mt),C=new W_(D,E,pe,te,g,c),le=new kb(D,te,gt),Re=new Xb(L,Ct,gt,pe),X=new q_(L,mt,Ct),ce=new a0(L,mt,Ct),Ct.programs=j.programs,D.capabilities=gt,D.extensions=mt,D.properties=De,D.renderLists=ue,D.shadowMap=le,D.state=pe,D.info=Ct}x!==rn&&(U=new u0(x,t.width,t.height,o,s,r));let se=new Tc(D,L);this.xr=se,this.getContext=function(){return L},this.getContextAttributes=function(){return L.getContextAttributes()},this.forceContextLoss=function(){let y=mt.get("WEBGL_lose_context");y&&y.loseContext()},this.forceContextRestore=function(){let y=mt.get("WEBGL_lose_context");y&&y.restoreContext()},this.getPixelRatio=function(){return be},this.setPixelRatio=function(y){y!==void 0&&(be=y,this.setSize(ye,Ie,!1))},this.getSize=function(y){return y.set(ye,Ie)},this.setSize=function(y,I,G=!0){if(se.isPresenting){Le("WebGLRenderer: Can't change size while VR device is presenting.");return}ye=y,Ie=I,t.width=Math.floor(y*be),t.height=Math.floor(I*be),G===!0&&(t.style.width=y+"px",t.style.height=I+"px"),U!==null&&U.setSize(t.width,t.height),this.setViewport(0,0,y,I)},this.getDrawingBufferSize=function(y){return y.set(ye*be,Ie*be).floor()},this.setDrawingBufferSize=function(y,I,G){ye=y,Ie=I,be=G,t.width=Math.floor(y*G),t.height=Math.floor(I*G),this.setViewport(0,0,y,I)},this.setEffects=function(y){if(x===rn){Ue("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(y){for(let I=0;I<y.length;I++)if(y[I].isOutputPass===!0){Le("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}U.setEffects(y||[])},this.getCurrentViewport=function(y){return y.copy(ee)},this.getViewport=function(y){return y.copy(Fe)},this.setViewport=function(y,I,G,k){y.isVector4?Fe.set(y.x,y.y,y.z,y.w):Fe.set(y,I,G,k),pe.viewport(ee.copy(Fe).multiplyScalar(pn()).round())},this.getScissor=function(y){return y.copy(st)},this.setScissor=function(y,I,G,k){y.isVector4?st.set(y.x,y.y,y.z,y.w):st.set(y,I,G,k),pe.scissor(Ae.copy(st).multiplyScalar(pn()).round())},this.getScissorTest=function(){return at},this.setScissorTest=function(y){pe.setScissorTest(at=y)},this.setOpaqueSort=function(y){Ve=y},this.setTransparentSort=function(y){Mt=y},this.getClearColor=function(y){return y.copy(C.getClearColor())},this.setClearColor=function(){C.setClearColor(...arguments)},this.getClearAlpha=function(){return C.getClearAlpha()},this.setClearAlpha=function(){C.setClearAlpha(...arguments)},this.clear=function(y=!0,I=!0,G=!0){let k=0;if(y){let z=!1;if(ie!==null){let de=ie.texture.format;z=m.has(de)}if(z){let de=ie.texture.type,ve=p.has(de),he=C.getClearColor(),xe=C.getClearAlpha(),Te=he.r,ze=he.g,Ze=he.b;ve?(v[0]=Te,v[1]=ze,v[2]=Ze,v[3]=xe,L.clearBufferuiv(L.COLOR,0,v)):(S[0]=Te,S[1]=ze,S[2]=Ze,S[3]=xe,L.clearBufferiv(L.COLOR,0,S))}else k|=L.COLOR_BUFFER_BIT}I&&(k|=L.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),G&&(k|=L.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),k!==0&&L.clear(k)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(y){y.setRenderer(this),B=y},this.dispose=function(){t.removeEventListener("webglcontextlost",Ce,!1),t.removeEventListener("webglcontextrestored",He,!1),t.removeEventListener("webglcontextcreationerror",me,!1),C.dispose(),ue.dispose(),Y.dispose(),Oe.dispose(),De.dispose(),E.dispose(),te.dispose(),O.dispose(),oe.dispose(),Re.dispose(),j.dispose(),se.dispose(),se.removeEventListener("sessionstart",$c),se.removeEventListener("sessionend",Jc),Di.stop()};function Ce(y){y.preventDefault(),uc("WebGLRenderer: Context Lost."),N=!0}function He(){uc("WebGLRenderer: Context Restored."),N=!1;let y=Ct.autoReset,I=le.enabled,G=le.autoUpdate,k=le.needsUpdate,z=le.type;We(),Ct.autoReset=y,le.enabled=I,le.autoUpdate=G,le.needsUpdate=k,le.type=z}function me(y){Ue("WebGLRenderer: A WebGL context could not be created. Reason: ",y.statusMessage)}function rt(y){let I=y.target;I.removeEventListener("dispose",rt),Nt(I)}function Nt(y){ci(y),De.remove(y)}function ci(y){let I=De.get(y).programs;I!==void 0&&(I.forEach(function(G){j.releaseProgram(G)}),y.isShaderMaterial&&j.releaseShaderCache(y))}this.renderBufferDirect=function(y,I,G,k,z,de){I===null&&(I=dn);let ve=z.isMesh&&z.matrixWorld.determinantAffine()<0,he=Hf(y,I,G,k,z);pe.setMaterial(k,ve);let xe=G.index,Te=1;if(k.wireframe===!0){if(xe=O.getWireframeAttribute(G),xe===void 0)return;Te=2}let ze=G.drawRange,Ze=G.attributes.position,we=ze.start*Te,$e=(ze.start+ze.count)*Te;de!==null&&(we=Math.max(we,de.start*Te),$e=Math.min($e,(de.start+de.count)*Te)),xe!==null?(we=Math.max(we,0),$e=Math.min($e,xe.count)):Ze!=null&&(we=Math.max(we,0),$e=Math.min($e,Ze.count));let At=$e-we;if(At<0||At===1/0)return;oe.setup(z,k,he,G,xe);let ht,ot=X;if(xe!==null&&(ht=b.get(xe),ot=ce,ot.setIndex(ht)),z.isMesh)k.wireframe===!0?(pe.setLineWidth(k.wireframeLinewidth*pn()),ot.setMode(L.LINES)):ot.setMode(L.TRIANGLES);else if(z.isLine){let Vt=k.linewidth;Vt===void 0&&(Vt=1),pe.setLineWidth(Vt*pn()),z.isLineSegments?ot.setMode(L.LINES):z.isLineLoop?ot.setMode(L.LINE_LOOP):ot.setMode(L.LINE_STRIP)}else z.isPoints?ot.setMode(L.POINTS):z.isSprite&&ot.setMode(L.TRIANGLES);if(z.isBatchedMesh)if(mt.get("WEBGL_multi_draw"))ot.renderMultiDraw(z._multiDrawStarts,z._multiDrawCounts,z._multiDrawCount);else{let Vt=z._multiDrawStarts,Se=z._multiDrawCounts,Kt=z._multiDrawCount,nt=xe?b.get(xe).bytesPerElement:1,Li=De.get(k).currentProgram.getUniforms();for(let Ht=0;Ht<Kt;Ht++)Li.setValue(L,"_gl_DrawID",Ht),ot.render(Vt[Ht]/nt,Se[Ht])}else if(z.isInstancedMesh)ot.renderInstances(we,At,z.count);else if(G.isInstancedBufferGeometry){let Vt=G._maxInstanceCount!==void 0?G._maxInstanceCount:1/0,Se=Math.min(G.instanceCount,Vt);ot.renderInstances(we,At,Se)}else ot.render(we,At)};function Zc(y,I,G,k){B!==null&&y.isNodeMaterial&&B.setObject(k,y),Rt===!0&&Z.setState(y,G,!1),y.transparent===!0&&y.side===sn&&y.forceSinglePass===!1?(y.side=Qt,y.needsUpdate=!0,Ns(y,I,k),y.side=Ti,y.needsUpdate=!0,Ns(y,I,k),y.side=sn):Ns(y,I,k)}this.compile=function(y,I,G=null){G===null&&(G=y),B!==null&&B.renderStart(y,I,G),A=Y.get(G),A.init(I),M.push(A),G.traverseVisible(function(z){z.isLight&&z.layers.test(I.layers)&&(A.pushLight(z),z.castShadow&&A.pushShadow(z))}),y!==G&&y.traverseVisible(function(z){z.isLight&&z.layers.test(I.layers)&&(A.pushLight(z),z.castShadow&&A.pushShadow(z))}),A.setupLights(),B!==null&&B.updateLights(A.state.lightsArray),en=this.localClippingEnabled,Rt=Z.init(this.clippingPlanes,en),Rt===!0&&Z.setGlobalState(this.clippingPlanes,I),B!==null&&le.render(A.state.shadowsArray,G,I);let k=new Set;return y.traverse(function(z){if(!(z.isMesh||z.isPoints||z.isLine||z.isSprite))return;let de=z.material;if(de)if(Array.isArray(de))for(let ve=0;ve<de.length;ve++){let he=de[ve];Zc(he,G,I,z),k.add(he)}else Zc(de,G,I,z),k.add(de)}),A=M.pop(),B!==null&&B.renderEnd(),k},this.compileAsync=function(y,I,G=null){let k=this.compile(y,I,G);return new Promise(z=>{function de(){if(k.forEach(function(ve){let xe=De.get(ve).currentProgram;(xe===void 0||xe.isReady())&&k.delete(ve)}),k.size===0){z(y);return}setTimeout(de,10)}mt.get("KHR_parallel_shader_compile")!==null?de():setTimeout(de,10)})};let el=null;function Gf(y){el&&el(y)}function $c(){Di.stop()}function Jc(){Di.start()}let Di=new yd;Di.setAnimationLoop(Gf),typeof self<"u"&&Di.setContext(self),this.setAnimationLoop=function(y){el=y,se.setAnimationLoop(y),y===null?Di.stop():Di.start()},se.addEventListener("sessionstart",$c),se.addEventListener("sessionend",Jc),this.render=function(y,I){if(I!==void 0&&I.isCamera!==!0){Ue("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(N===!0)return;B!==null&&B.renderStart(y,I);let G=se.enabled===!0&&se.isPresenting===!0,k=U!==null&&(ie===null||G)&&U.begin(D,ie);if(y.matrixWorldAutoUpdate===!0&&y.updateMatrixWorld(),I.parent===null&&I.matrixWorldAutoUpdate===!0&&I.updateMatrixWorld(),se.enabled===!0&&se.isPresenting===!0&&(U===null||U.isCompositing()===!1)&&(se.cameraAutoUpdate===!0&&se.updateCamera(I),I=se.getCamera()),y.isScene===!0&&y.onBeforeRender(D,y,I,ie),A=Y.get(y,M.length),A.init(I),A.state.textureUnits=Oe.getTextureUnits(),M.push(A),vt.multiplyMatrices(I.projectionMatrix,I.matrixWorldInverse),I.isArrayCamera?Ot.setFromArrayCamera(I):Ye.setFromProjectionMatrix(vt,_n,I.reversedDepth),en=this.localClippingEnabled,Rt=Z.init(this.clippingPlanes,en),T=ue.get(y,_.length),T.init(),_.push(T),this.info.render.frame++,se.enabled===!0&&se.isPresenting===!0){let ve=D.xr.getDepthSensingMesh();ve!==null&&tl(ve,I,-1/0,D.sortObjects)}tl(y,I,0,D.sortObjects),T.finish(),B!==null&&B.updateLights(A.state.lightsArray),D.sortObjects===!0&&T.sort(Ve,Mt),fn=se.enabled===!1||se.isPresenting===!1||se.hasDepthSensing()===!1,fn&&C.addToRenderList(T,y),this.info.autoReset===!0&&this.info.reset(),Rt===!0&&Z.beginShadows();let z=A.state.shadowsArray;if(le.render(z,y,I),Rt===!0&&Z.endShadows(),(k&&U.hasRenderPass())===!1){let ve=T.opaque,he=T.transmissive;if(A.setupLights(),I.isArrayCamera){let xe=I.cameras;if(he.length>0)for(let Te=0,ze=xe.length;Te<ze;Te++){let Ze=xe[Te];Qc(ve,he,y,Ze)}fn&&C.render(y);for(let Te=0,ze=xe.length;Te<ze;Te++){let Ze=xe[Te];jc(T,y,Ze,Ze.viewport)}}else he.length>0&&Qc(ve,he,y,I),fn&&C.render(y),jc(T,y,I)}ie!==null&&V===0&&(Oe.updateMultisampleRenderTarget(ie),Oe.updateRenderTargetMipmap(ie)),k&&U.end(D),y.isScene===!0&&y.onAfterRender(D,y,I),oe.resetDefaultState(),q=-1,Q=null,M.pop(),M.length>0?(A=M[M.length-1],Oe.setTextureUnits(A.state.textureUnits),Rt===!0&&Z.setGlobalState(D.clippingPlanes,A.state.camera)):A=null,_.pop(),_.length>0?T=_[_.length-1]:T=null,B!==null&&B.renderEnd()};function tl(y,I,G,k){if(y.visible===!1)return;if(y.layers.test(I.layers)){if(y.isGroup)G=y.renderOrder;else if(y.isLOD)y.autoUpdate===!0&&y.update(I);else if(y.isLight)A.pushLight(y),y.castShadow&&A.pushShadow(y);else if(y.isSprite){let ve=I.isArrayCamera?Ot:Ye;if(!y.frustumCulled||y.intersectsFrustum(ve)){k&&Lt.setFromMatrixPosition(y.matrixWorld).applyMatrix4(vt);let he=te.update(y),xe=y.material;xe.visible&&T.push(y,he,xe,G,Lt.z,null,I)}}else if(y.isMesh||y.isLine||y.isPoints){let ve=I.isArrayCamera?Ot:Ye;if(!y.frustumCulled||y.intersectsFrustum(ve)){let he=te.update(y),xe=y.material;if(k&&(y.boundingSphere!==void 0?(y.boundingSphere===null&&y.computeBoundingSphere(),Lt.copy(y.boundingSphere.center)):(he.boundingSphere===null&&he.computeBoundingSphere(),Lt.copy(he.boundingSphere.center)),Lt.applyMatrix4(y.matrixWorld).applyMatrix4(vt)),Array.isArray(xe)){let Te=he.groups;for(let ze=0,Ze=Te.length;ze<Ze;ze++){let we=Te[ze],$e=xe[we.materialIndex];$e&&$e.visible&&T.push(y,he,$e,G,Lt.z,we,I)}}else xe.visible&&T.push(y,he,xe,G,Lt.z,null,I)}}}let de=y.children;for(let ve=0,he=de.length;ve<he;ve++)tl(de[ve],I,G,k)}function jc(y,I,G,k){let{opaque:z,transmissive:de,transparent:ve}=y;A.setupLightsView(G),Rt===!0&&Z.setGlobalState(D.clippingPlanes,G),k&&pe.viewport(ee.copy(k)),z.length>0&&Fr(z,I,G),de.length>0&&Fr(de,I,G),ve.length>0&&Fr(ve,I,G),pe.buffers.depth.setTest(!0),pe.buffers.depth.setMask(!0),pe.buffers.color.setMask(!0),pe.setPolygonOffset(!1)}function Qc(y,I,G,k){if((G.isScene===!0?G.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[k.id]===void 0){let we=mt.has("EXT_color_buffer_half_float")||mt.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[k.id]=new hn(1,1,{generateMipmaps:!0,type:we?En:rn,minFilter:ri,samples:Math.max(4,gt.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Je.workingColorSpace})}let de=A.state.transmissionRenderTarget[k.id],ve=k.viewport||ee;de.setSize(ve.z*D.transmissionResolutionScale,ve.w*D.transmissionResolutionScale);let he=D.getRenderTarget(),xe=D.getActiveCubeFace(),Te=D.getActiveMipmapLevel();D.setRenderTarget(de),D.getClearColor($),_e=D.getClearAlpha(),_e<1&&D.setClearColor(16777215,.5),D.clear(),fn&&C.render(G);let ze=D.toneMapping;D.toneMapping=Bn;let Ze=k.viewport;if(k.viewport!==void 0&&(k.viewport=void 0),A.setupLightsView(k),Rt===!0&&Z.setGlobalState(D.clippingPlanes,k),Fr(y,G,k),Oe.updateMultisampleRenderTarget(de),Oe.updateRenderTargetMipmap(de),mt.has("WEBGL_multisampled_render_to_texture")===!1){let we=!1;for(let $e=0,At=I.length;$e<At;$e++){let ht=I[$e],{object:ot,geometry:Vt,material:Se,group:Kt}=ht;if(Se.side===sn&&ot.layers.test(k.layers)){let nt=Se.side;Se.side=Qt,Se.needsUpdate=!0,eh(ot,G,k,Vt,Se,Kt),Se.side=nt,Se.needsUpdate=!0,we=!0}}we===!0&&(Oe.updateMultisampleRenderTarget(de),Oe.updateRenderTargetMipmap(de))}D.setRenderTarget(he,xe,Te),D.setClearColor($,_e),Ze!==void 0&&(k.viewport=Ze),D.toneMapping=ze}function Fr(y,I,G){let k=I.isScene===!0?I.overrideMaterial:null;for(let z=0,de=y.length;z<de;z++){let ve=y[z],{object:he,geometry:xe,group:Te}=ve,ze=ve.material;ze.allowOverride===!0&&k!==null&&(ze=k),he.layers.test(G.layers)&&eh(he,I,G,xe,ze,Te)}}function eh(y,I,G,k,z,de){B!==null&&z.isNodeMaterial&&B.setObject(y,z),y.onBeforeRender(D,I,G,k,z,de),y.modelViewMatrix.multiplyMatrices(G.matrixWorldInverse,y.matrixWorld),y.normalMatrix.getNormalMatrix(y.modelViewMatrix),z.onBeforeRender(D,I,G,k,y,de),z.transparent===!0&&z.side===sn&&z.forceSinglePass===!1?(z.side=Qt,z.needsUpdate=!0,D.renderBufferDirect(G,I,k,z,y,de),z.side=Ti,z.needsUpdate=!0,D.renderBufferDirect(G,I,k,z,y,de),z.side=sn):D.renderBufferDirect(G,I,k,z,y,de),y.onAfterRender(D,I,G,k,z,de)}function th(y){let I=0;for(let G of y)G.texture!==null&&I++;return I}function Ns(y,I,G){I.isScene!==!0&&(I=dn);let k=De.get(y),z=A.state.lights,de=A.state.shadowsArray,ve=z.state.version,he=j.getParameters(y,z.state,de,I,G,A.state.lightProbeGridArray),xe=j.getProgramCacheKey(he),Te=k.programs;k.environment=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?I.environment:null,k.fog=I.fog;let ze=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap;k.envMap=E.get(y.envMap||k.environment,ze),k.envMapRotation=k.environment!==null&&y.envMap===null?I.environmentRotation:y.envMapRotation,Te===void 0&&(y.addEventListener("dispose",rt),Te=new Map,k.programs=Te,k.programVariants=new Map);let Ze=Te.get(xe);if(Ze!==void 0){if(k.currentProgram===Ze&&k.lightsStateVersion===ve)return ih(y,he),Ze}else he.uniforms=j.getUniforms(y),B!==null&&y.isNodeMaterial&&B.build(y,G,he),y.onBeforeCompile(he,D),Ze=j.acquireProgram(he,xe),Te.set(xe,Ze),k.uniforms=he.uniforms;let we=k.uniforms;return(!y.isShaderMaterial&&!y.isRawShaderMaterial||y.clipping===!0)&&(we.clippingPlanes=Z.uniform),ih(y,he),k.needsLights=Xf(y),k.lightsStateVersion=ve,k.needsLights&&(we.ambientLightColor.value=z.state.ambient,we.lightProbe.value=z.state.probe,we.sunLights.value=z.state.sun,we.sunLightShadows.value=z.state.sunShadow,we.directionalLights.value=z.state.directional,we.directionalLightShadows.value=z.state.directionalShadow,we.spotLights.value=z.state.spot,we.spotLightShadows.value=z.state.spotShadow,we.rectAreaLights.value=z.state.rectArea,we.ltc_1.value=z.state.rectAreaLTC1,we.ltc_2.value=z.state.rectAreaLTC2,we.pointLights.value=z.state.point,we.pointLightShadows.value=z.state.pointShadow,we.hemisphereLights.value=z.state.hemi,we.sunShadowMatrix.value=z.state.sunShadowMatrix,we.sunShadowCascade.value=z.state.sunShadowCascade,we.directionalShadowMatrix.value=z.state.directionalShadowMatrix,we.spotLightMatrix.value=z.state.spotLightMatrix,we.spotLightMap.value=z.state.spotLightMap,we.pointShadowMatrix.value=z.state.pointShadowMatrix),k.numLightProbeGrids=th(A.state.lightProbeGridArray),k.currentProgram=Ze,k.uniformsList=null,Ze}function Vf(y,I,G,k,z){let de=De.get(y),ve=de.currentProgram.id+","+k+","+z,he=de.programVariants.get(ve);return he===void 0?(he=Ns(y,I,G),de.programVariants.set(ve,he)):(de.currentProgram=he,de.uniformsList=null,de.outputColorSpace=k,de.toneMapping=z),he}function nh(y){if(y.uniformsList===null){let I=y.currentProgram.getUniforms();y.uniformsList=Cs.seqWithValue(I.seq,y.uniforms)}return y.uniformsList}function ih(y,I){let G=De.get(y);G.outputColorSpace=I.outputColorSpace,G.batching=I.batching,G.batchingColor=I.batchingColor,G.instancing=I.instancing,G.instancingColor=I.instancingColor,G.instancingMorph=I.instancingMorph,G.skinning=I.skinning,G.morphTargets=I.morphTargets,G.morphNormals=I.morphNormals,G.morphColors=I.morphColors,G.morphTargetsCount=I.morphTargetsCount,G.numClippingPlanes=I.numClippingPlanes,G.numIntersection=I.numClipIntersection,G.vertexAlphas=I.vertexAlphas,G.vertexTangents=I.vertexTangents,G.toneMapping=I.toneMapping}function Hf(y,I,G,k,z){I.isScene!==!0&&(I=dn),Oe.resetTextureUnits();let de=I.fog,ve=k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial?I.environment:null,he=ie===null?D.outputColorSpace:ie.isXRRenderTarget===!0?ie.texture.colorSpace:Je.workingColorSpace,xe=k.isMeshStandardMaterial||k.isMeshLambertMaterial&&!k.envMap||k.isMeshPhongMaterial&&!k.envMap,Te=E.get(k.envMap||ve,xe),ze=k.vertexColors===!0&&!!G.attributes.color&&G.attributes.color.itemSize===4,Ze=!!G.attributes.tangent&&(!!k.normalMap||k.anisotropy>0),we=!!G.morphAttributes.position,$e=!!G.morphAttributes.normal,At=!!G.morphAttributes.color,ht=Bn;k.toneMapped&&(ie===null||ie.isXRRenderTarget===!0)&&(ht=D.toneMapping);let ot=G.morphAttributes.position||G.morphAttributes.normal||G.morphAttributes.color,Vt=ot!==void 0?ot.length:0,Se=De.get(k),Kt=A.state.lights;if(Rt===!0&&(en===!0||y!==Q)){let yt=y===Q&&k.id===q;Z.setState(k,y,yt)}let nt=!1,Li=!1;k.version===Se.__version?Se.needsLights&&Se.lightsStateVersion!==Kt.state.version||z.isBatchedMesh&&Se.batching===!1||!z.isBatchedMesh&&Se.batching===!0||z.isBatchedMesh&&Se.batchingColor===!0&&z._colorsTexture===null||z.isBatchedMesh&&Se.batchingColor===!1&&z._colorsTexture!==null||z.isInstancedMesh&&Se.instancing===!1||!z.isInstancedMesh&&Se.instancing===!0||z.isSkinnedMesh&&Se.skinning===!1||!z.isSkinnedMesh&&Se.skinning===!0||z.isInstancedMesh&&Se.instancingColor===!0&&z.instanceColor===null||z.isInstancedMesh&&Se.instancingColor===!1&&z.instanceColor!==null||z.isInstancedMesh&&Se.instancingMorph===!0&&z.morphTexture===null||z.isInstancedMesh&&Se.instancingMorph===!1&&z.morphTexture!==null||Se.envMap!==Te||k.fog===!0&&Se.fog!==de||Se.numClippingPlanes!==void 0&&(Se.numClippingPlanes!==Z.numPlanes||Se.numIntersection!==Z.numIntersection)||Se.vertexAlphas!==ze||Se.vertexTangents!==Ze||Se.morphTargets!==we||Se.morphNormals!==$e||Se.morphColors!==At||Se.morphTargetsCount!==Vt||Se.numLightProbeGrids!==th(A.state.lightProbeGridArray)?nt=!0:(Se.outputColorSpace!==he||Se.toneMapping!==ht)&&(Li=!0):(nt=!0,Se.__version=k.version);let Ht=Se.currentProgram;(nt===!0||Li===!0)&&(Ht=Li===!0?Vf(k,I,z,he,ht):Ns(k,I,z),B&&k.isNodeMaterial&&B.onUpdateProgram(k,Ht,Se));let Ur=!1,hi=!1,Ni=!1,et=Ht.getUniforms(),Bt=Se.uniforms;if(pe.useProgram(Ht.program)&&(Ur=!0,hi=!0,Ni=!0),k.id!==q&&(q=k.id,hi=!0),Ur||Q!==y){pe.buffers.depth.getReversed()&&y.reversedDepth!==!0&&(y._reversedDepth=!0,y.updateProjectionMatrix()),et.setValue(L,"projectionMatrix",y.projectionMatrix),et.setValue(L,"viewMatrix",y.matrixWorldInverse);let Ft=et.map.cameraPosition;Ft!==void 0&&Ft.setValue(L,Pn.setFromMatrixPosition(y.matrixWorld)),gt.logarithmicDepthBuffer&&et.setValue(L,"logDepthBufFC",2/(Math.log(y.far+1)/Math.LN2)),(k.isMeshPhongMaterial||k.isMeshToonMaterial||k.isMeshLambertMaterial||k.isMeshBasicMaterial||k.isMeshStandardMaterial||k.isShaderMaterial)&&et.setValue(L,"isOrthographic",y.isOrthographicCamera===!0),Q!==y&&(Q=y,hi=!0,Ni=!0)}if(Se.needsLights&&(Kt.state.sunShadowMap.length>0&&et.setValue(L,"sunShadowMap",Kt.state.sunShadowMap,Oe),Kt.state.directionalShadowMap.length>0&&et.setValue(L,"directionalShadowMap",Kt.state.directionalShadowMap,Oe),Kt.state.spotShadowMap.length>0&&et.setValue(L,"spotShadowMap",Kt.state.spotShadowMap,Oe),Kt.state.pointShadowMap.length>0&&et.setValue(L,"pointShadowMap",Kt.state.pointShadowMap,Oe)),z.isSkinnedMesh){et.setOptional(L,z,"bindMatrix"),et.setOptional(L,z,"bindMatrixInverse");let yt=z.skeleton;yt&&(yt.boneTexture===null&&yt.computeBoneTexture(),et.setValue(L,"boneTexture",yt.boneTexture,Oe))}z.isBatchedMesh&&(et.setOptional(L,z,"batchingTexture"),et.setValue(L,"batchingTexture",z._matricesTexture,Oe),et.setOptional(L,z,"batchingIdTexture"),et.setValue(L,"batchingIdTexture",z._indirectTexture,Oe),et.setOptional(L,z,"batchingColorTexture"),z._colorsTexture!==null&&et.setValue(L,"batchingColorTexture",z._colorsTexture,Oe));let xn=G.morphAttributes;if((xn.position!==void 0||xn.normal!==void 0||xn.color!==void 0)&&J.update(z,G,Ht),(hi||Se.receiveShadow!==z.receiveShadow)&&(Se.receiveShadow=z.receiveShadow,et.setValue(L,"receiveShadow",z.receiveShadow)),(k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial)&&k.envMap===null&&I.environment!==null&&(Bt.envMapIntensity.value=I.environmentIntensity),Bt.dfgLUT!==void 0&&(Bt.dfgLUT.value=Kb()),hi){if(et.setValue(L,"toneMappingExposure",D.toneMappingExposure),Se.needsLights&&Wf(Bt,Ni),de&&k.fog===!0&&ae.refreshFogUniforms(Bt,de),ae.refreshMaterialUniforms(Bt,k,be,Ie,A.state.transmissionRenderTarget[y.id]),Se.needsLights&&Se.numLightProbeGrids>0){let yt=w,Ft=0;for(let Hn of A.state.lightProbeGridArray)Hn.texture!==null&&(yt.textures[Ft]=Hn.texture,yt.min[Ft]=Hn.boundingBox.min,yt.max[Ft]=Hn.boundingBox.max,yt.resolution[Ft]=Hn.resolution,Ft++);for(let Hn in yt)yt[Hn].length=Ft;Bt.probesSH.value=yt.textures,Bt.probesMin.value=yt.min,Bt.probesMax.value=yt.max,Bt.probesResolution.value=yt.resolution}Cs.upload(L,nh(Se),Bt,Oe)}if(k.isShaderMaterial&&k.uniformsNeedUpdate===!0&&(Cs.upload(L,nh(Se),Bt,Oe),k.uniformsNeedUpdate=!1),k.isSpriteMaterial&&et.setValue(L,"center",z.center),et.setValue(L,"modelViewMatrix",z.modelViewMatrix),et.setValue(L,"normalMatrix",z.normalMatrix),et.setValue(L,"modelMatrix",z.matrixWorld),k.uniformsGroups!==void 0){let yt=k.uniformsGroups;for(let Ft=0,Hn=yt.length;Ft<Hn;Ft++){let rh=yt[Ft];Re.update(rh,Ht),Re.bind(rh,Ht)}}return Ht}function Wf(y,I){y.ambientLightColor.needsUpdate=I,y.lightProbe.needsUpdate=I,y.sunLights.needsUpdate=I,y.sunLightShadows.needsUpdate=I,y.directionalLights.needsUpdate=I,y.directionalLightShadows.needsUpdate=I,y.pointLights.needsUpdate=I,y.pointLightShadows.needsUpdate=I,y.spotLights.needsUpdate=I,y.spotLightShadows.needsUpdate=I,y.rectAreaLights.needsUpdate=I,y.hemisphereLights.needsUpdate=I}function Xf(y){return y.isMeshLambertMaterial||y.isMeshToonMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isShadowMaterial||y.isShaderMaterial&&y.lights===!0}this.getActiveCubeFace=function(){return K},this.getActiveMipmapLevel=function(){return V},this.getRenderTarget=function(){return ie},this.setRenderTargetTextures=function(y,I,G){let k=De.get(y);k.__autoAllocateDepthBuffer=y.resolveDepthBuffer===!1,k.__autoAllocateDepthBuffer===!1&&(k.__useRenderToTexture=!1),De.get(y.texture).__webglTexture=I,De.get(y.depthTexture).__webglTexture=k.__autoAllocateDepthBuffer?void 0:G,k.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(y,I){let G=De.get(y);G.__webglFramebuffer=I,G.__useDefaultFramebuffer=I===void 0},this.setRenderTarget=function(y,I=0,G=0){ie=y,K=I,V=G;let k=null,z=!1,de=!1;if(y){let he=De.get(y);if(he.__useDefaultFramebuffer!==void 0){pe.bindFramebuffer(L.FRAMEBUFFER,he.__webglFramebuffer),ee.copy(y.viewport),Ae.copy(y.scissor),Be=y.scissorTest,pe.viewport(ee),pe.scissor(Ae),pe.setScissorTest(Be),q=-1;return}else if(he.__webglFramebuffer===void 0)Oe.setupRenderTarget(y);else if(he.__hasExternalTextures)Oe.rebindTextures(y,De.get(y.texture).__webglTexture,De.get(y.depthTexture).__webglTexture);else if(y.depthBuffer){let ze=y.depthTexture;if(he.__boundDepthTexture!==ze){if(ze!==null&&De.has(ze)&&(y.width!==ze.image.width||y.height!==ze.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Oe.setupDepthRenderbuffer(y)}}let xe=y.texture;(xe.isData3DTexture||xe.isDataArrayTexture||xe.isCompressedArrayTexture)&&(de=!0);let Te=De.get(y).__webglFramebuffer;y.isWebGLCubeRenderTarget?(Array.isArray(Te[I])?k=Te[I][G]:k=Te[I],z=!0):y.samples>0&&Oe.useMultisampledRTT(y)===!1?k=De.get(y).__webglMultisampledFramebuffer:Array.isArray(Te)?k=Te[G]:k=Te,ee.copy(y.viewport),Ae.copy(y.scissor),Be=y.scissorTest}else ee.copy(Fe).multiplyScalar(be).floor(),Ae.copy(st).multiplyScalar(be).floor(),Be=at;if(G!==0&&(k=W),pe.bindFramebuffer(L.FRAMEBUFFER,k)&&pe.drawBuffers(y,k),pe.viewport(ee),pe.scissor(Ae),pe.setScissorTest(Be),z){let he=De.get(y.texture);L.framebufferTexture2D(L.FRAMEBUFFER,L.COLOR_ATTACHMENT0,L.TEXTURE_CUBE_MAP_POSITIVE_X+I,he.__webglTexture,G)}else if(de){let he=I;for(let xe=0;xe<y.textures.length;xe++){let Te=De.get(y.textures[xe]);L.framebufferTextureLayer(L.FRAMEBUFFER,L.COLOR_ATTACHMENT0+xe,Te.__webglTexture,G,he)}}else if(y!==null&&G!==0){let he=De.get(y.texture);L.framebufferTexture2D(L.FRAMEBUFFER,L.COLOR_ATTACHMENT0,L.TEXTURE_2D,he.__webglTexture,G)}q=-1};function sh(y){let I=De.get(y);return(I.__readFormat!==y.format||I.__readType!==y.type)&&(I.__readFormat=y.format,I.__readType=y.type,I.__formatReadable=gt.textureFormatReadable(y.format),I.__typeReadable=gt.textureTypeReadable(y.type)),I}this.readRenderTargetPixels=function(y,I,G,k,z,de,ve,he=0){if(!(y&&y.isWebGLRenderTarget)){Ue("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xe=De.get(y).__webglFramebuffer;if(y.isWebGLCubeRenderTarget&&ve!==void 0&&(xe=xe[ve],Array.isArray(xe)&&(xe=xe[0])),xe){pe.bindFramebuffer(L.FRAMEBUFFER,xe);try{let Te=y.textures[he],ze=Te.format,Ze=Te.type;y.textures.length>1&&L.readBuffer(L.COLOR_ATTACHMENT0+he);let we=sh(Te);if(we.__formatReadable===!1){Ue("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(we.__typeReadable===!1){Ue("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}I>=0&&I<=y.width-k&&G>=0&&G<=y.height-z&&L.readPixels(I,G,k,z,re.convert(ze),re.convert(Ze),de)}finally{let Te=ie!==null?De.get(ie).__webglFramebuffer:null;pe.bindFramebuffer(L.FRAMEBUFFER,Te)}}},this.readRenderTargetPixelsAsync=async function(y,I,G,k,z,de,ve,he=0){if(!(y&&y.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xe=De.get(y).__webglFramebuffer;if(y.isWebGLCubeRenderTarget&&ve!==void 0&&(xe=xe[ve],Array.isArray(xe)&&(xe=xe[0])),xe)if(I>=0&&I<=y.width-k&&G>=0&&G<=y.height-z){pe.bindFramebuffer(L.FRAMEBUFFER,xe);let Te=y.textures[he],ze=Te.format,Ze=Te.type;y.textures.length>1&&L.readBuffer(L.COLOR_ATTACHMENT0+he);let we=sh(Te);if(we.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(we.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let $e=L.createBuffer();L.bindBuffer(L.PIXEL_PACK_BUFFER,$e),L.bufferData(L.PIXEL_PACK_BUFFER,de.byteLength,L.STREAM_READ),L.readPixels(I,G,k,z,re.convert(ze),re.convert(Ze),0),L.bindBuffer(L.PIXEL_PACK_BUFFER,null);let At=ie!==null?De.get(ie).__webglFramebuffer:null;pe.bindFramebuffer(L.FRAMEBUFFER,At);let ht=L.fenceSync(L.SYNC_GPU_COMMANDS_COMPLETE,0);return L.flush(),await Ku(L,ht,4),L.bindBuffer(L.PIXEL_PACK_BUFFER,$e),L.getBufferSubData(L.PIXEL_PACK_BUFFER,0,de),L.bindBuffer(L.PIXEL_PACK_BUFFER,null),L.deleteBuffer($e),L.deleteSync(ht),de}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(y,I=null,G=0){let k=Math.pow(2,-G),z=Math.floor(y.image.width*k),de=Math.floor(y.image.height*k),ve=I!==null?I.x:0,he=I!==null?I.y:0;Oe.setTexture2D(y,0),L.copyTexSubImage2D(L.TEXTURE_2D,G,0,0,ve,he,z,de),pe.unbindTexture()},this.copyTextureToTexture=function(y,I,G=null,k=null,z=0,de=0){let ve,he,xe,Te,ze,Ze,we,$e,At,ht=y.isCompressedTexture?y.mipmaps[de]:y.image;if(G!==null)ve=G.max.x-G.min.x,he=G.max.y-G.min.y,xe=G.isBox3?G.max.z-G.min.z:1,Te=G.min.x,ze=G.min.y,Ze=G.isBox3?G.min.z:0;else{let et=Math.pow(2,-z);ve=Math.floor(ht.width*et),he=Math.floor(ht.height*et),y.isDataArrayTexture?xe=ht.depth:y.isData3DTexture?xe=Math.floor(ht.depth*et):xe=1,Te=0,ze=0,Ze=0}k!==null?(we=k.x,$e=k.y,At=k.z):(we=0,$e=0,At=0);let ot=re.convert(I.format),Vt=re.convert(I.type),Se;I.isData3DTexture?(Oe.setTexture3D(I,0),Se=L.TEXTURE_3D):I.isDataArrayTexture||I.isCompressedArrayTexture?(Oe.setTexture2DArray(I,0),Se=L.TEXTURE_2D_ARRAY):(Oe.setTexture2D(I,0),Se=L.TEXTURE_2D),pe.activeTexture(L.TEXTURE0),pe.pixelStorei(L.UNPACK_FLIP_Y_WEBGL,I.flipY),pe.pixelStorei(L.UNPACK_PREMULTIPLY_ALPHA_WEBGL,I.premultiplyAlpha),pe.pixelStorei(L.UNPACK_ALIGNMENT,I.unpackAlignment);let Kt=pe.getParameter(L.UNPACK_ROW_LENGTH),nt=pe.getParameter(L.UNPACK_IMAGE_HEIGHT),Li=pe.getParameter(L.UNPACK_SKIP_PIXELS),Ht=pe.getParameter(L.UNPACK_SKIP_ROWS),Ur=pe.getParameter(L.UNPACK_SKIP_IMAGES);pe.pixelStorei(L.UNPACK_ROW_LENGTH,ht.width),pe.pixelStorei(L.UNPACK_IMAGE_HEIGHT,ht.height),pe.pixelStorei(L.UNPACK_SKIP_PIXELS,Te),pe.pixelStorei(L.UNPACK_SKIP_ROWS,ze),pe.pixelStorei(L.UNPACK_SKIP_IMAGES,Ze);let hi=y.isDataArrayTexture||y.isData3DTexture,Ni=I.isDataArrayTexture||I.isData3DTexture;if(y.isDepthTexture){let et=De.get(y),Bt=De.get(I),xn=De.get(et.__renderTarget),yt=De.get(Bt.__renderTarget);pe.bindFramebuffer(L.READ_FRAMEBUFFER,xn.__webglFramebuffer),pe.bindFramebuffer(L.DRAW_FRAMEBUFFER,yt.__webglFramebuffer);for(let Ft=0;Ft<xe;Ft++)hi&&(L.framebufferTextureLayer(L.READ_FRAMEBUFFER,L.COLOR_ATTACHMENT0,De.get(y).__webglTexture,z,Ze+Ft),L.framebufferTextureLayer(L.DRAW_FRAMEBUFFER,L.COLOR_ATTACHMENT0,De.get(I).__webglTexture,de,At+Ft)),L.blitFramebuffer(Te,ze,Te+ve,ze+he,we,$e,we+ve,$e+he,L.DEPTH_BUFFER_BIT,L.NEAREST);pe.bindFramebuffer(L.READ_FRAMEBUFFER,null),pe.bindFramebuffer(L.DRAW_FRAMEBUFFER,null)}else if(z!==0||y.isRenderTargetTexture||De.has(y)){let et=De.get(y),Bt=De.get(I);pe.bindFramebuffer(L.READ_FRAMEBUFFER,P),pe.bindFramebuffer(L.DRAW_FRAMEBUFFER,H);for(let xn=0;xn<xe;xn++)hi?L.framebufferTextureLayer(L.READ_FRAMEBUFFER,L.COLOR_ATTACHMENT0,et.__webglTexture,z,Ze+xn):L.framebufferTexture2D(L.READ_FRAMEBUFFER,L.COLOR_ATTACHMENT0,L.TEXTURE_2D,et.__webglTexture,z),Ni?L.framebufferTextureLayer(L.DRAW_FRAMEBUFFER,L.COLOR_ATTACHMENT0,Bt.__webglTexture,de,At+xn):L.framebufferTexture2D(L.DRAW_FRAMEBUFFER,L.COLOR_ATTACHMENT0,L.TEXTURE_2D,Bt.__webglTexture,de),z!==0?L.blitFramebuffer(Te,ze,Te+ve,ze+he,we,$e,we+ve,$e+he,L.COLOR_BUFFER_BIT,L.NEAREST):Ni?L.copyTexSubImage3D(Se,de,we,$e,At+xn,Te,ze,ve,he):L.copyTexSubImage2D(Se,de,we,$e,Te,ze,ve,he);pe.bindFramebuffer(L.READ_FRAMEBUFFER,null),pe.bindFramebuffer(L.DRAW_FRAMEBUFFER,null)}else Ni?y.isDataTexture||y.isData3DTexture?L.texSubImage3D(Se,de,we,$e,At,ve,he,xe,ot,Vt,ht.data):I.isCompressedArrayTexture?L.compressedTexSubImage3D(Se,de,we,$e,At,ve,he,xe,ot,ht.data):L.texSubImage3D(Se,de,we,$e,At,ve,he,xe,ot,Vt,ht):y.isDataTexture?L.texSubImage2D(L.TEXTURE_2D,de,we,$e,ve,he,ot,Vt,ht.data):y.isCompressedTexture?L.compressedTexSubImage2D(L.TEXTURE_2D,de,we,$e,ht.width,ht.height,ot,ht.data):L.texSubImage2D(L.TEXTURE_2D,de,we,$e,ve,he,ot,Vt,ht);pe.pixelStorei(L.UNPACK_ROW_LENGTH,Kt),pe.pixelStorei(L.UNPACK_IMAGE_HEIGHT,nt),pe.pixelStorei(L.UNPACK_SKIP_PIXELS,Li),pe.pixelStorei(L.UNPACK_SKIP_ROWS,Ht),pe.pixelStorei(L.UNPACK_SKIP_IMAGES,Ur),de===0&&I.generateMipmaps===!0&&I.mipmapsAutoUpdate===!0&&L.generateMipmap(Se),pe.unbindTexture()},this.initRenderTarget=function(y){De.get(y).__webglFramebuffer===void 0&&Oe.setupRenderTarget(y)},this.initTexture=function(y){y.isCubeTexture?Oe.setTextureCube(y,0):y.isData3DTexture?Oe.setTexture3D(y,0):y.isDataArrayTexture||y.isCompressedArrayTexture?Oe.setTexture2DArray(y,0):Oe.setTexture2D(y,0),pe.unbindTexture()},this.resetState=function(){K=0,V=0,ie=null,pe.reset(),oe.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return _n}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=Je._getDrawingBufferColorSpace(e),t.unpackColorSpace=Je._getUnpackColorSpace()}};var Dd=.008,Ho=.12,Yb=1.5,Zb=.2,$b=4,Wo=class{constructor(e,t){this.moved=t;e.addEventListener("pointerdown",i=>{e.setPointerCapture(i.pointerId),this.fingers.set(i.pointerId,{x:i.clientX,y:i.clientY})});for(let i of["pointerup","pointercancel"])e.addEventListener(i,s=>this.fingers.delete(s.pointerId));e.addEventListener("pointermove",i=>this.drag(i)),e.addEventListener("wheel",i=>this.wheel(i),{passive:!1}),e.addEventListener("keydown",i=>this.key(i))}moved;azimuth=-.9;height=.5;zoom=1;fingers=new Map;centre=new F(.3,0,.3);radius=1;place(e){let t=Math.cos(this.height),i=this.radius*this.zoom/Math.sin(e.fov*Math.PI/360)/Math.min(1,e.aspect);e.position.set(t*Math.cos(this.azimuth),t*Math.sin(this.azimuth),Math.sin(this.height)).multiplyScalar(i).add(this.centre),e.near=i/100,e.far=i*20,e.lookAt(this.centre)}turn(e,t){this.azimuth-=e,this.height=Math.min(Yb,Math.max(-.2,this.height+t)),this.moved()}scale(e){this.zoom=Math.min($b,Math.max(Zb,this.zoom*e)),this.moved()}drag(e){let t=this.fingers.get(e.pointerId);if(!t)return;let i={x:e.clientX,y:e.clientY},s=[...this.fingers].find(([r])=>r!==e.pointerId)?.[1];if(this.fingers.set(e.pointerId,i),s){let r=a=>Math.hypot(a.x-s.x,a.y-s.y);this.scale(r(t)/Math.max(1,r(i)))}else this.turn((i.x-t.x)*Dd,(i.y-t.y)*Dd)}wheel(e){e.preventDefault(),this.scale(Math.exp(e.deltaY*.001))}key(e){let i={ArrowLeft:[-Ho,0],ArrowRight:[Ho,0],ArrowUp:[0,Ho],ArrowDown:[0,-Ho]}[e.key];if(i)this.turn(...i);else if(e.key==="+")this.scale(1/1.2);else if(e.key==="-")this.scale(1.2);else return;e.preventDefault(),e.stopPropagation()}};function Ri(n){return new ct().compose(new F(...n.translation_m),new bn(...n.rotation_xyzw),new F(1,1,1))}function Ci(n,e,t=1){let i=new nn;return i.setAttribute("position",new wt(n,3)),new rr(i,new ws({color:e,transparent:t<1,opacity:t}))}function Ld(n,e,t){let i=n?.fx||e,s=n?.fy||i;return[e/2/i,t/2/s]}function Rc([n,e],t){let i=[[-1,-1],[1,-1],[1,1],[-1,1]].map(([l=0,u=0])=>[l*n*t,u*e*t,t]),s=[0,0,0],r=i.flatMap((l,u)=>[s,l,l,i[(u+1)%4]]),[a,o]=[i[0],i[1]],c=[0,a[1]*1.35,t];return[...r,a,c,c,o]}function Pr({left:n,top:e,right:t,bottom:i}){let s=[[n,e,0],[t,e,0],[t,i,0],[n,i,0]];return s.flatMap((r,a)=>[r,s[(a+1)%4]])}function Cc(n){return[[0,0,0],[n,0,0],[0,0,0],[0,n,0],[0,0,0],[0,0,n]]}function Pc(n,e,t,i){let s=e.flatMap(r=>n.flatMap(a=>new F(...a).applyMatrix4(r).toArray()));return Ci(s,t,i)}function Ic(n,e,t,i){let s=new tn;s.add(Ci(Rc(n,e).flat(),t));let[r,a,o,c]=[[-1,-1],[1,-1],[1,1],[-1,1]].map(([f=0,g=0])=>[f*n[0]*e,g*n[1]*e,e]),l=new nn,u=[0,0,0],d=[u,r,a,u,a,o,u,o,c,u,c,r].flat();l.setAttribute("position",new wt(d,3));let h=new xi({color:t,transparent:!0,opacity:.13,side:sn,depthWrite:!1});if(s.add(new Et(l,h)),i){let f=new yi(.022,.022,.05,24);f.rotateX(Math.PI/2),s.add(new Et(f,new si({color:t})))}return s}function Jb([n,e]){let t=document.createElement("canvas");t.width=n,t.height=e;let i=t.getContext("2d");for(let r=0;r<e;r+=1)for(let a=0;a<n;a+=1)i.fillStyle=(r+a)%2?"#f2f4f7":"#20262e",i.fillRect(a,r,1,1);let s=new or(t);return s.magFilter=St,s.generateMipmaps=!1,s.minFilter=St,s.colorSpace=Zt,s.flipY=!1,s}function Nd(n){let e=new tn;if(n.radius)return e.add(new Et(new wi(n.radius,32,24),new si({color:"#c9d1db"}))),e;let[t,i]=[n.right-n.left,n.bottom-n.top],s=new Xi(t,i),r=n.squares?new xi({map:Jb(n.squares),side:sn}):new xi({color:"#e6eaef",side:sn}),a=new Et(s,r);return a.position.set((n.left+n.right)/2,(n.top+n.bottom)/2,0),e.add(a,Ci(Pr(n).flat(),"#808b99")),e}function Dc(n){let e=new tn,t=[["#e5484d",[n,0,0]],["#2f9e57",[0,n,0]],["#3b82f6",[0,0,n]]];for(let[i,s]of t)e.add(Ci([0,0,0,...s],i));return e}function Lc(n,e,t){let i=new F().subVectors(t,e);n.position.addVectors(e,t).multiplyScalar(.5),n.scale.set(1,Math.max(i.length(),1e-6),1),n.quaternion.setFromUnitVectors(new F(0,1,0),i.normalize())}var Ec=.035,jb=.001,Cr=class{constructor(e){this.look=e}look;group=new tn;tube=new yi(Ec,Ec,1,20);ball=new wi(Ec*1.25,20,14);parts=[];update(e){let t=(e??[]).map(i=>new F(...i));for(;this.parts.length<t.length-1;){let i={joint:new Et(this.ball,this.look),link:new Et(this.tube,this.look)};this.group.add(i.joint,i.link),this.parts.push(i)}this.parts.forEach(({joint:i,link:s},r)=>{let[a,o]=[t[r],t[r+1]];i.visible=!!(a&&o),s.visible=!!(a&&o&&a.distanceTo(o)>jb),!(!a||!o)&&(i.position.copy(a),s.visible&&Lc(s,a,o))})}};function Fd(n,e,t){let i=new F().addVectors(n,e).multiplyScalar(.5),s=n.distanceTo(e)/2,r=Math.sqrt(Math.max(0,(t/2)**2-s**2));return i.add(new F(0,0,r))}var an=(n,e,t)=>({name:n,label:e,kind:"count",initial:t}),Cn=(n,e,t)=>({name:n,label:e,kind:"length",initial:t}),Nc={name:"dictionary",label:"dictionary",kind:"dictionary",initial:"DICT_5X5_100"},Xo={checkerboard:{label:"checkerboard",fields:[an("columns","inner_columns",9),an("rows","inner_rows",6),Cn("square_mm","square",30)]},charuco:{label:"charuco",fields:[an("squares_x","squares_x",9),an("squares_y","squares_y",6),Cn("square_mm","square",28),Cn("marker_mm","marker",21),Nc]},aprilgrid:{label:"aprilgrid",fields:[an("tags_x","tags_x",6),an("tags_y","tags_y",6),Cn("tag_mm","tag_size",30),{name:"spacing",label:"spacing",kind:"ratio",initial:.3},{name:"family",label:"family",kind:"family",initial:"36h11"}]},"tag-grid":{label:"tag_grid",fields:[an("tags_x","tags_x",5),an("tags_y","tags_y",4),Cn("tag_mm","tag_size",40),Cn("gap_mm","gap",10),Nc]},tag:{label:"tag",fields:[Nc,{name:"id",label:"tag_id",kind:"id",initial:0},Cn("size_mm","tag_size",60)]},"circle-grid":{label:"circle_grid",fields:[an("columns","circles_x",9),an("rows","circles_y",7),Cn("pitch_mm","pitch",20)]},"asymmetric-circle-grid":{label:"asymmetric_circle_grid",fields:[an("columns","circles_x",4),an("rows","circles_y",11),Cn("pitch_mm","row_pitch",20)]},"modified-circle-grid":{label:"modified_circle_grid",fields:[an("columns","circles_x",10),an("rows","circles_y",10),Cn("pitch_mm","pitch",20)]},sphere:{label:"sphere",fields:[Cn("diameter_mm","diameter",40)]}},Qb=["4X4","5X5","6X6","7X7"].flatMap(n=>[50,100,250,1e3].map(e=>`DICT_${n}_${e}`)),Fc=["16h5","25h9","36h10","36h11"],Ud=[...Qb,"DICT_ARUCO_ORIGINAL",...Fc.map(n=>`DICT_APRILTAG_${n}`)];function Ir(n){let e=(h,f)=>{let g=Number(n?.[h]);return Number.isFinite(g)&&g>0?g:f},t=(h,f,g,x,m=null)=>{let[p,v,S,w]=[h/1e3,f/1e3,g/1e3,x/1e3];return{left:p,top:v,right:S,bottom:w,squares:m,radius:null}},[i,s,r]=[e("columns",9),e("rows",6),e("pitch_mm",20)],[a,o]=[e("squares_x",i),e("squares_y",s)],c=e("square_mm",30),l=e("tag_mm",30),u=e("gap_mm",l*e("spacing",.3)),d=h=>h*l+(h-1)*u;switch(n?.kind){case"charuco":return t(0,0,a*c,o*c,[a,o]);case"circle-grid":return t(-r,-r,i*r,s*r);case"asymmetric-circle-grid":return t(-r,-r,2*i*r,s*r);case"modified-circle-grid":return t(-r,-s*r,i*r,r);case"aprilgrid":return t(-u,-d(e("tags_y",6))-u,d(e("tags_x",6))+u,u);case"tag-grid":return t(-u,-u,d(e("tags_x",5))+u,d(e("tags_y",4))+u);case"tag":return t(-.6*e("size_mm",60),-.6*e("size_mm",60),.6*e("size_mm",60),.6*e("size_mm",60));case"sphere":return{...t(-20,-20,20,20),radius:e("diameter_mm",40)/2e3};default:return t(-c,-c,i*c,s*c,[i+1,s+1])}}var Uc=.14,kd=.07,Od=.1,ex=.22;function Bd(){let n=getComputedStyle(document.documentElement),e=t=>n.getPropertyValue(t).trim();return{paper:e("--scene"),line:e("--scene-line"),arm:e("--scene-arm"),camera:e("--accent"),next:e("--next"),earlier:e("--soft"),selected:e("--ink")}}var zd=(n,e)=>n&&e?Ri(n).multiply(Ri(e)):null;function kc(n,e){let{mount_from_camera:t,anchor_from_target:i}=n.progress??{};return n.cell?.setup==="eye-to-hand"?{camera:t?Ri(t):null,target:zd(e,i)}:{camera:zd(e,t),target:i?Ri(i):null}}function Gd(n){let e=R("canvas",{tabindex:0,role:"img"});bt(e,"cell_3d");let t=Me(R("p",{class:"without"}),"no_3d"),i=R("div",{class:"pane cell"},e,t),s=Ke("swap",()=>n.choose({large:n.choices.large==="cell"?"picture":"cell"}),{icon:"swap",bare:!0,class:"swap"});i.append(s);let r=null;try{r=new Bc(e,i)}catch{e.hidden=!0}return fe(t,r===null),{element:i,update(a){i.clientWidth&&r?.update(a,n.choices.selected)}}}var Ji=class{made="";group=new tn;set(e,t){if(e===this.made)return!1;this.made=e,this.group.clear();for(let i of t())this.group.add(i);return!0}},Bc=class{constructor(e,t){this.element=t;this.renderer=new zo({canvas:e,antialias:!0}),this.renderer.setPixelRatio(Math.min(2,devicePixelRatio)),this.orbit=new Wo(e,()=>this.draw()),this.eye.up.set(0,0,1),this.links=[.07,.055,.045,.035].map(s=>new Et(new yi(s,s,1,24),this.armLook)),this.joints=[.065,.055,.045].map(s=>new Et(new wi(s,24,16),this.armLook));let i=new mr("#ffffff",2);i.position.set(1,-1.5,3),this.scene.add(new dr("#ffffff","#8a93a0",2),i,Dc(.2),this.flange),this.scene.add(this.model.group,this.ghost.group,...this.links,...this.joints,...Object.values(this.pieces).map(s=>s.group)),new ResizeObserver(()=>this.draw()).observe(t),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>{this.looks=Bd();for(let s of Object.values(this.pieces))s.set("",()=>[]);this.drawn="",this.draw()})}element;renderer;scene=new tr;eye=new $t(35,1,.01,100);orbit;pieces={board:new Ji,camera:new Ji,next:new Ji,captures:new Ji,floor:new Ji};flange=Dc(.1);links;joints;armLook=new si({color:"#9aa7b8"});ghostLook=new si({transparent:!0,opacity:ex,depthWrite:!1});model=new Cr(this.armLook);ghost=new Cr(this.ghostLook);looks=Bd();reach=1;bend=new F(0,0,.6);pending=!1;drawn="";update(e,t){let i=tx(e,t);if(i===this.drawn)return;this.drawn=i;let s=kc(e,e.robot?.base_from_flange),r=zt(e)?kc(e,e.next?.base_from_flange):{camera:null,target:null};this.floor(),this.arm(e.robot?.base_from_flange,e.arm?.points),this.ghost.update(zt(e)?e.arm?.next_points:null),this.board(e,s.target),this.camera(e,s.camera),this.next(e,r),this.captures(e,t),this.frame(e,s),this.draw()}floor(){this.pieces.floor.set("floor",()=>{let e=10*Od,t=[];for(let i=-e;i<=e+1e-9;i+=Od)t.push(-e,i,0,e,i,0,i,-e,0,i,e,0);return this.scene.background=new Xe(this.looks.paper),this.armLook.color.set(this.looks.arm),this.ghostLook.color.set(this.looks.next),[Ci(t,this.looks.line)]})}arm(e,t){this.model.update(t);for(let l of[...this.links,...this.joints])l.visible=!!e&&!t;if(this.flange.visible=!!e,!e)return;let i=Ri(e);if(this.flange.matrixAutoUpdate=!1,this.flange.matrix.copy(i),t){this.bend.copy(nx(t));return}let s=new F().setFromMatrixPosition(i),r=new F(0,0,-.12).applyMatrix4(i),a=new F(0,0,.25);this.reach=Math.max(this.reach,a.distanceTo(r)*1.15);let o=Fd(a,r,this.reach),c=[new F,a,o,r,s];this.links.forEach((l,u)=>Lc(l,c[u],c[u+1])),this.joints.forEach((l,u)=>l.position.copy(c[u+1])),this.bend.copy(o)}board(e,t){let i=e.cell?.target;this.pieces.board.set(JSON.stringify(i??null),()=>[Nd(Ir(i))]),Oc(this.pieces.board.group,t)}view(e){return Ld(e.cell?.intrinsics,e.camera?.width||1280,e.camera?.height||800)}camera(e,t){let i=this.view(e);this.pieces.camera.set(String(i),()=>[Ic(i,Uc,this.looks.camera,!0)]),Oc(this.pieces.camera.group,t)}next(e,{camera:t,target:i}){let s=e.cell?.setup==="eye-to-hand",r=zt(e)?e.next?.base_from_flange:null,a=s?i:t,o=this.view(e);this.pieces.next.set(`${a!==null} ${s} ${o} ${JSON.stringify(e.cell?.target??null)}`,()=>a?s?[Ci(Pr(Ir(e.cell?.target)).flat(),this.looks.next)]:[Ic(o,Uc,this.looks.next,!0)]:[Ci(Cc(Uc).flat(),this.looks.next)]),Oc(this.pieces.next.group,a??(r?Ri(r):null))}captures(e,t){let i=e.captures??[],{mount_from_camera:s,anchor_from_target:r}=e.progress??{},a=JSON.stringify([i.map(({id:o,used:c})=>[o,c]),s,r,t,e.cell?.setup]);this.pieces.captures.set(a,()=>{let o=e.cell?.setup==="eye-to-hand",c=!!(o?r:s),l=c?o?Pr(Ir(e.cell?.target)):Rc(this.view(e),kd):Cc(kd),u=h=>c?kc(e,h)[o?"target":"camera"]:h?Ri(h):null,d=h=>i.filter(({id:f})=>f===t===h).map(f=>u(f.base_from_flange)).filter(f=>f!==null);return[Pc(l,d(!1),this.looks.earlier,.75),Pc(l,d(!0),this.looks.selected,1)]})}frame(e,{camera:t,target:i}){let s=[new F,this.bend];t&&s.push(new F().setFromMatrixPosition(t));let r=Ir(e.cell?.target);i&&s.push(...Pr(r).map(d=>new F(...d).applyMatrix4(i)));let a=e.next?.base_from_flange;for(let d of[e.robot?.base_from_flange,a])d&&s.push(new F(...d.translation_m));let o=s.reduce((d,h)=>d.clone().min(h)),c=s.reduce((d,h)=>d.clone().max(h)),l=o.clone().add(c).multiplyScalar(.5),u=Math.max(.4,...s.map(d=>1.08*d.distanceTo(l)));l.distanceTo(this.orbit.centre)>.1*u&&this.orbit.centre.copy(l),Math.abs(u-this.orbit.radius)>.15*u&&(this.orbit.radius=u)}draw(){this.pending||(this.pending=!0,requestAnimationFrame(()=>{this.pending=!1;let{clientWidth:e,clientHeight:t}=this.element;!e||!t||(this.renderer.setSize(e,t,!1),this.eye.aspect=e/t,this.orbit.place(this.eye),this.eye.updateProjectionMatrix(),this.renderer.render(this.scene,this.eye))}))}};function tx(n,e){let{cell:t,robot:i,arm:s,camera:r,captures:a,progress:o}=n,c=a?.map(({id:h,used:f,base_from_flange:g})=>[h,f,g]),l=[i?.base_from_flange,s,n.next?.base_from_flange,o?.mount_from_camera,o?.anchor_from_target],u=[t?.target,t?.setup,t?.intrinsics,r?.width,r?.height],d=(h,f)=>typeof f=="number"?Math.round(f*1e4):f;return JSON.stringify([l,u,c,e,zt(n)],d)}function nx(n){return n.map(e=>new F(...e)).reduce((e,t)=>t.z>e.z?t:e,new F)}function Oc(n,e){n.visible=e!==null,e&&(n.matrixAutoUpdate=!1,n.matrix.copy(e))}var ix=3;function Vd(){let n=Pt("warning"),[e,t]=[R("p"),R("p",{class:"advice"})],i=R("li",{class:"finding"},n,R("div",{},e,t));return{element:i,update(s){lt(e,s.message,Ut),lt(t,s.advice,Ut),fe(t,!!s.advice),on(n,s.severity==="info"?"page":"warning"),Ne(i,"rejects",s.severity==="rejects"),Ne(i,"changes",s.severity==="changes-answer")}}}function sx(n,e){let t=e.progress?.verdict==="rejected";return n.severity==="rejects"&&!t?"info":n.severity??"info"}var rx="touches-not-enough";function qo(n,e){let t=R("ul",{class:"findings"}),i=e==="changes-answer"?"grave":null,s=R("section",{class:`card of-${e}`,id:i},Me(R("h2"),e==="info"?"remarks":"findings"),t),r=ut(t,({code:a,message:o})=>`${a} ${o}`,Vd);return{element:s,update(a){let l=(a.progress?.findings??[]).filter(({code:u})=>a.step!=="touch"||u!==rx).map(u=>({...u,severity:sx(u,a)})).filter(u=>u.severity===e);r(l),fe(s,l.length>0)}}}function Hd(n){let e=R("ul",{class:"findings"}),t=R("section",{class:"card"},Me(R("h2"),"refused"),e),i=ut(e,({code:s})=>s??"",Vd);return{element:t,update(s){let r=[...s.refused??[]].reverse().slice(0,ix);i(r.map(({time_s:a,why:o})=>({code:`${a} ${o}`,severity:"changes-answer",message:o}))),fe(t,r.length>0)}}}var ax={taken:[[660,0,.09],[990,.08,.14]],refused:[[220,0,.16],[175,.17,.26]],enough:[[523,0,.14],[659,.12,.14],[784,.24,.14],[1047,.36,.35]]},Pi=null;function Wd(){Pi??=typeof AudioContext>"u"?null:new AudioContext,Pi?.resume()}function Ko(n){if(!(!Pi||Pi.state!=="running"))for(let[e,t,i]of ax[n]){let s=Pi.currentTime+t,r=Pi.createOscillator(),a=Pi.createGain();r.type=n==="refused"?"triangle":"sine",r.frequency.value=e,a.gain.setValueAtTime(0,s),a.gain.linearRampToValueAtTime(.25,s+.01),a.gain.exponentialRampToValueAtTime(.001,s+i),r.connect(a).connect(Pi.destination),r.start(s),r.stop(s+i+.02)}}var ox=1500,lx=4,cx=1e4;function Xd(n,e){"own"in e?Yt(n,ne(e.own)):lt(n,e.said,Ut)}function Is(n,e,t){let i=R("strong"),s=R("span"),r=R("div",{class:`notice ${n}`},Pt(e),R("p",{},i," ",s));t&&r.append(Ke("close",t,{icon:"cross",bare:!0,class:"plain"})),r.hidden=!0;let a=0;return{element:r,set(o,c=!0){o?(a=0,Xd(i,o.message),Xd(s,o.advice??{said:[]}),fe(r,!0)):r.hidden||(a||=performance.now(),(!c||performance.now()-a>ox)&&fe(r,!1))}}}function zc(n){return n.step==="result"&&n.result?.verdict&&n.result.verdict!=="accepted"?{message:{own:n.result.verdict==="rejected"?"result_rejected":"result_undetermined"},advice:{said:n.progress?.reasons??[]}}:n.progress?.verdict==="rejected"?{message:{own:"rejected_so_far"},advice:{said:n.progress.reasons??[]}}:null}function qd(n){return n.signedOut?{message:{own:"signed_out"},advice:{own:"signed_out_advice"}}:n.lostSince===null?null:{message:{own:"lost"},advice:{own:"lost_advice"}}}function Kd(n,e){let t=Is("bad","warning"),i=Is("bad","warning"),s=Is("bad","cross",()=>{n.refused=null,n.redraw()}),r=Is("bad","warning"),a=Is("doubtful","warning",()=>{o=!0,n.redraw()}),o=!1,c=Is("doubtful","cross",()=>{l=0,n.redraw()}),l=0,u=null,d=R("div",{role:"alert"},t.element,i.element,s.element),h=R("div",{role:"status"},r.element,a.element,c.element);e.append(d,h);let f=g=>g?{message:g.message?{said:g.message}:{own:"not_sent"},advice:{said:g.advice??[]}}:null;return{element:e,update(g){t.set(qd(n),!1);let m=g.problem?.code==="not-assessed"&&(g.captures?.length??0)<lx?null:g.problem,p=g.problem?.code==="image-late";i.set(p?null:f(m)),a.set(p&&!o&&g.step==="capture"?f(g.problem):null,!1),s.set(f(n.refused),!1);let v=zc(g);r.set(g.step==="result"?null:v);let S=g.refused?.[g.refused.length-1],w=S?`${S.time_s} ${S.why}`:"";u!==null&&w&&w!==u&&(l=performance.now()+cx),u=w;let T=g.problem?.code==="not-taken",A=S&&!T&&performance.now()<l;c.set(A?{message:{own:"capture_refused"},advice:{said:S.why}}:null,!1),Ne(document.body,"trouble",!!(qd(n)||m&&!p||n.refused||v)),Ne(document.body,"lost",n.lostSince!==null)}}}var hx=700,Gc=n=>{let e=n.refused?.[n.refused.length-1];return e?`${e.time_s} ${e.why}`:""};function Yd(n,e,t){if(!e||n.choices.muted)return;let i=new Set([...e.captures??[],...e.deleted??[]].map(({id:o})=>o)),s=t.captures?.some(({id:o})=>!i.has(o)),r=Gc(t)!==""&&Gc(t)!==Gc(e),a=!!(zc(t)??t.problem);t.progress?.enough&&!e.progress?.enough&&!a?Ko("enough"):r?Ko("refused"):s&&Ko("taken")}function Zd(n){let e="",t;return i=>{let s=[i.problem?.message??"",Or(i)??""].filter(Boolean),r=`${Bi()} ${s.join(" ")}`;r!==e&&(e=r,clearTimeout(t),t=setTimeout(()=>lt(n,s,a=>a," "),hx))}}var ux=[27,24,21,18,16,14],dx=78;function $d(n){for(let e of ux)if(n.style.fontSize=`${e}px`,n.scrollHeight<=dx)return}function Jd(n){let e=null,t=R("span"),i=R("button",{type:"button",class:n},t);return i.addEventListener("click",s=>{s.detail>0&&i.blur(),e?.enabled&&e.run()}),{element:i,update(s){e=s,Me(t,s.label),Pe(i,"aria-disabled",!s.enabled&&"true"),Pe(i,"aria-pressed",s.on===void 0?null:String(s.on))}}}function jd(n,e){let t=R("h1"),i=R("div",{class:"others"}),s=Jd("primary"),r=R("span",{class:"busy","aria-hidden":"true"});s.element.prepend(r),s.element.append(R("kbd",{"aria-hidden":"true"},"␣"));let a=ut(i,c=>c.label,()=>Jd("large"));e.append(t,i,s.element);let o=0;return new ResizeObserver(()=>{t.clientWidth!==o&&(o=t.clientWidth,$d(t))}).observe(t),{element:e,update(c){let l=ki(n,c);s.update(l),Ne(s.element,"waiting",!!(c.taking||c.virtual_cell?.driving)),a(n.state?_h(n,c):[]);let u=t.textContent;n.state?lt(t,Or(c)):Yt(t,ne("connecting")),t.textContent!==u&&$d(t)}}}var fx=[[["␣","↵"],"key_primary"],[["N"],"key_next"],[["T"],"key_take"],[["A"],"key_automatic"],[["↑","↓"],"key_select"],[["D"],"key_delete"],[["R"],"key_retake"],[["Z"],"key_undo"],[["1","6"],"key_steps"],[["C"],"key_swap"],[["M"],"key_mute"],[["Esc"],"key_escape"],[["?"],"key_help"]];function Qd(){let n=fx.flatMap(([t,i])=>[R("dt",{},...t.flatMap((s,r)=>[r&&t[0]==="1"?" – ":r?" ":null,R("kbd",{},s)])),Me(R("dd"),i)]),e=R("dialog",{},Me(R("h2"),"keys"),R("dl",{class:"keys"},...n));return e.append(Ke("close",()=>e.close(),{class:"large"})),bt(e,"keys"),e.addEventListener("click",t=>{t.target===e&&e.close()}),e}var px=350;function mx(n){return n instanceof HTMLInputElement?n.type!=="radio":n instanceof HTMLTextAreaElement||n instanceof HTMLSelectElement}function gx(n){return!!n?.closest("button, a, summary, input, [role=tabpanel]")}function _x(n){n.choices.selected&&n.send({do:"retake",id:n.choices.selected})}function bx(n){n.choices.selected?n.choose({selected:null}):n.state?.taking&&zr(n)}function xx(n,e,t){let i=n.state,s=i!==null&&zt(i),r=i?.steps?.[Number(e)-1];if(r)return()=>Gr(n,r.name);switch(e.toLowerCase()){case" ":case"enter":return()=>{let a=i&&ki(n,i);a?.enabled&&a.run()};case"n":return()=>s&&xh(n);case"t":return()=>s&&Os(i)&&void Bs(n);case"a":return()=>s&&void n.send({do:"automatic",on:!i.automatic});case"d":case"delete":return()=>vh(n);case"r":return()=>_x(n);case"z":return()=>i?.can_undo&&void n.send({do:"undo"});case"arrowdown":case"arrowleft":return()=>sl(n,-1);case"arrowup":case"arrowright":return()=>sl(n,1);case"c":return()=>n.choose({large:n.choices.large==="cell"?"picture":"cell"});case"m":return()=>n.choose({muted:!n.choices.muted});case"escape":return()=>bx(n);case"?":return()=>t.showModal();default:return null}}function ef(n,e){let t={key:"",at:0};addEventListener("keydown",i=>{if(i.ctrlKey||i.metaKey||i.altKey||i.defaultPrevented||e.open)return;let s=document.activeElement;if(mx(s)||(i.key===" "||i.key==="Enter")&&gx(s)||i.key.startsWith("Arrow")&&s instanceof HTMLInputElement)return;let a=xx(n,i.key,e);!a||(i.preventDefault(),i.key===t.key&&i.timeStamp-t.at<px&&!i.key.startsWith("Arrow")||i.repeat&&!i.key.startsWith("Arrow"))||(t={key:i.key,at:i.timeStamp},a())})}var vx=3,Ds=[];function Vc(n){let e=Ds[Ds.length-1];return e?Ds.find(t=>t.number===n)??e:null}async function tf(n,e){let t=null;for(;;){if(document.hidden||!n()){await Qi(200);continue}try{let i=await fetch(t===null?"/api/live.jpg":`/api/live.jpg?after=${t}`);i.status===200?(t=i.headers.get("x-frame"),yx({number:Number(t),image:await createImageBitmap(await i.blob())}),e(),t===null&&await Qi(100)):(t=null,await Qi(i.status===204?100:1e3))}catch{t=null,await Qi(1e3)}}}function yx(n){for(Ds.push(n);Ds.length>vx;)Ds.shift()?.image.close()}var wx=2e3;function nf(n){let e=new Map;async function t(i,s,r){s.asking=!0;try{s.detail=await Fs(`/api/captures/${encodeURIComponent(i)}.json`),s.assessed=r,n()}catch{await new Promise(a=>setTimeout(a,wx))}s.asking=!1}return{update(i,s){let r=(i.captures??[]).filter(({corners:a})=>a);for(let a of e.keys())r.some(o=>o.id===a)||e.delete(a);if(![...e.values()].some(({asking:a})=>a))for(let{id:a,time_s:o}of[...r].sort((c,l)=>+(l.id===s)-+(c.id===s))){let c=e.get(a);c?.time!==o&&(c=void 0),c||e.set(a,c={time:o,assessed:void 0,detail:null,asking:!1});let l=a===s&&c.assessed!==i.assessed;if(!(c.detail&&!l)){t(a,c,i.assessed);return}}},of:i=>e.get(i)?.detail??null}}var li=(n,[e,t])=>[n.left+(e+.5)*n.scale,n.top+(t+.5)*n.scale],Dr=n=>[n.reduce((e,t)=>e+t[0],0)/n.length,n.reduce((e,t)=>e+t[1],0)/n.length];function ji(n,e,t){n.strokeStyle="rgba(0,0,0,0.55)",n.lineWidth=t+2,n.stroke(),n.strokeStyle=e,n.lineWidth=t,n.stroke()}function Yo(n,e,t,i){n.beginPath();for(let s of t){let[r,a]=li(e,s);n.moveTo(r+i,a),n.arc(r,a,i,0,2*Math.PI)}}function Wc(n,e,t,i,s,r){n.font='600 14px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';let a=n.measureText(e).width+16,o=Math.max(6,Math.min(r.width-a-6,t-a/2)),c=Math.max(6,Math.min(r.height-30,i-12));n.fillStyle="rgba(8,12,18,0.78)",n.beginPath(),n.roundRect(o,c,a,24,6),n.fill(),n.fillStyle=s,n.textBaseline="middle",n.textAlign="left",n.fillText(e,o+8,c+12.5)}function af(n,e,t,i){n.fillStyle=i.earlier;for(let s of t)for(let r of s){let[a,o]=li(e,r);n.fillRect(a-1.5,o-1.5,3,3)}}function Sx(n,e){let[t,i]=[e.map(([r])=>r),e.map(([,r])=>r)],s=(Math.max(...t)-Math.min(...t))*(Math.max(...i)-Math.min(...i));return Math.min(5.5,Math.max(2,.14*n.scale*Math.sqrt(s/Math.max(1,e.length))))}function of(n,e,t,i){Yo(n,e,t,Sx(e,t)),ji(n,i.found,1.8)}function Mx(n,e,t){n.beginPath(),t.forEach((i,s)=>s?n.lineTo(...li(e,i)):n.moveTo(...li(e,i))),n.closePath()}function lf(n,e,t,i){let s=t.next?.ghost??[],r=t.next?.ghost_corners??[];if(s.length>2&&(Mx(n,e,s),n.fillStyle=i.next,n.globalAlpha=.14,n.fill(),n.globalAlpha=1,n.setLineDash([10,6]),ji(n,i.next,2.5),n.setLineDash([])),Yo(n,e,r,2.5),n.fillStyle=i.next,n.fill(),t.next?.number!==void 0&&s.length>2){let a=s.map(c=>li(e,c)),o=Math.min(...a.map(([,c])=>c));Wc(n,ne("view_number",{number:t.next.number}),Dr(a)[0],o-18,i.next,e)}}function Ax(n,e){if(n.length!==e.length||n.length<3)return null;let[t,i]=[Dr(n),Dr(e)],[s,r,a]=[0,0,0];return n.forEach((o,c)=>{let l=e[c],[u,d,h,f]=[o[0]-t[0],o[1]-t[1],l[0]-i[0],l[1]-i[1]];s+=u*h+d*f,r+=u*f-d*h,a+=u*u+d*d}),a===0?null:{angle:Math.atan2(r,s),scale:Math.hypot(s,r)/a}}var Tx=12;function Hc(n,e,t,i,s=Tx){for(let r of[-2.6,2.6])n.moveTo(e,t),n.lineTo(e+s*Math.cos(i+r),t+s*Math.sin(i+r))}var Ex=40,sf=.12,rf=.08,Rx=64;function cf(n,e,t,i){let s=t.camera?.corners??[],r=t.next?.ghost_corners??[];if(!s.length||r.length<3)return;let[a,o]=li(e,Dr(s)),[c,l]=li(e,Dr(r)),u=Math.hypot(c-a,l-o),d=Math.atan2(l-o,c-a);n.lineCap="round",u>Ex&&(n.beginPath(),n.moveTo(a,o),n.lineTo(c,l),Hc(n,c,l,d,16),ji(n,i.next,4));let h=Ax(s,r);if(!h)return;for(let[x,m]of[[s,i.found],[r,i.next]])Yo(n,e,x.slice(0,1),9),ji(n,m,2.5);if(Math.abs(h.angle)>sf){let m=-Math.PI/2,p=m+h.angle;n.beginPath(),n.arc(a,o,44,m,p,h.angle<0);let v=p+(h.angle>0?Math.PI/2:-Math.PI/2);Hc(n,a+44*Math.cos(p),o+44*Math.sin(p),v),ji(n,i.next,3)}let f=[Math.abs(h.angle)>sf?ne("rotate_by",{deg:Math.round(Math.abs(h.angle*180/Math.PI))}):"",h.scale>1+rf?ne("nearer"):h.scale<1-rf?ne("farther"):""].filter(Boolean),g=Math.max(...[...t.next?.ghost??[],...s].map(x=>li(e,x)[1]));f.length&&Wc(n,f.join(", "),c,Math.min(g+24,e.height-Rx),i.next,e)}var Cx=34;function Px(n,e){let t=Math.max(0,...n.map(([r,a])=>Math.hypot(r,a)));if(t===0)return 1;let i=Cx/(t*e.scale),s=10**Math.floor(Math.log10(i));return Math.max(1,[5,2,1].map(r=>r*s).find(r=>r<=i)??s)}function hf(n,e,t,i,s){let r=i?.points??[],a=i?.arrows??[];if(Yo(n,e,r,2),ji(n,s.found,1.5),!a.length)return;let o=Px(a,e);n.beginPath(),r.forEach((l,u)=>{let[d,h]=a[u]??[0,0],[f,g]=li(e,l),[x,m]=[f+d*o*e.scale,g+h*o*e.scale];n.moveTo(f,g),n.lineTo(x,m),Hc(n,x,m,Math.atan2(h,d),6)}),ji(n,vn(t)?s.outlier:s.residual,2);let c=ne("arrows_longer",{factor:o,px:tt(t.residual_px)});Wc(n,c,e.width/2,e.height-20,"#fff",e)}var Lr={found:"#4be3ff",next:"#ffc531",earlier:"rgba(150,205,255,0.5)",residual:"#ffe14d",outlier:"#ff7a6b"},df=2,Ix=2e3,Dx=4;function Lx(n){let e=new Map;return({id:t,time_s:i})=>{let s=`${t} ${i}`,r=e.get(s);if(r!==void 0)return r;e.set(s,null);for(let a of[...e.keys()].slice(0,-Dx))e.get(a)?.close(),e.delete(a);return(async()=>{try{let a=await fetch(`/api/captures/${encodeURIComponent(t)}.jpg`);if(!a.ok)throw new Error(a.statusText);e.set(s,await createImageBitmap(await a.blob()))}catch{setTimeout(()=>e.delete(s),Ix);return}n()})(),null}}function ff(n){let e=R("canvas",{"aria-hidden":"true"}),t=R("canvas",{role:"img"}),i=R("p",{class:"tag"}),s=Ke("back_to_live",()=>n.choose({selected:null}),{icon:"back"}),r=R("p",{class:"caption bad"}),a=R("div",{class:"pane picture"},e,t,R("div",{class:"corner"},s,i),r);bt(t,"live_picture");let o=Lx(()=>h()),c=nf(()=>{h(),n.redraw()}),l=!1,u=null,d="";new ResizeObserver(()=>h()).observe(a);function h(){l||(l=!0,requestAnimationFrame(()=>{l=!1,n.state&&g(n.state)}))}function f(v,S){let{clientWidth:w,clientHeight:T}=a,A=S.camera?.width||v?.width||1280,_=S.camera?.height||v?.height||800,M=Math.min(w/A,T/_);return{scale:M,left:(w-A*M)/2,top:(T-_*M)/2,width:w,height:T}}function g(v){let S=Us(n),w=S?o(S):Vc(v.camera?.frame)?.image??null,T=f(w,v);if(T.width===0||T.height===0)return;let A=Math.min(2,devicePixelRatio),_=`${T.width} ${T.height} ${T.scale} ${A}`;(w!==u||_!==d)&&x(w,T,A),[u,d]=[w,_];let M=uf(t,T,A);S?hf(M,T,S,c.of(S.id),Lr):m(M,T,v)}function x(v,S,w){let T=uf(e,S,w);v&&v.width&&T.drawImage(v,S.left,S.top,S.width-2*S.left,S.height-2*S.top)}function m(v,S,w){if(w.step==="capture"){let T=(w.captures??[]).filter(A=>!vn(A));af(v,S,T.map(({id:A})=>c.of(A)?.points??[]),Lr),lf(v,S,w,Lr)}w.camera?.corners?.length&&of(v,S,w.camera.corners,Lr),zt(w)&&cf(v,S,w,Lr)}return{element:a,draw:h,update(v){let S=Us(n);fe(s,S!==null),c.update(v,n.choices.selected),p(v,S),h()}};function p(v,S){let w=v.camera?.age_s,T=S===null&&(v.camera?.connected===!1||!v.camera?.single&&(w??0)>df);Ee(i,S?Fx(S):Ux(v)),Ne(i,"bad",T||S!==null&&vn(S));let A=S?S.reason:Nx(v)?v.camera?.missing:null;lt(r,A,Ut),fe(r,!!A),bt(t,S?"captured_picture":"live_picture")}}function Nx(n){if(!Xn(n))return!0;let e=Fi(n);return e?.lays===!0&&(!!n.taking||!Ui(e))}function Fx(n){let e=vn(n)?` · ${ne("not_used")}`:"";return`${ne("capture_id",{id:n.id})} · ${tt(n.residual_mm)} mm · ${tt(n.residual_px)} px${e}`}function Ux(n){let e=n.camera;return e?.frame?Vc(e.frame)?e.single?[ne("picture_number",{number:e.frame??""}),e.found&&Ln(e.found)].filter(Boolean).join(" · "):(e?.age_s??0)>df?ne("picture_old",{seconds:Math.round(e?.age_s??0)}):e?.found?`${ne("live")} · ${Ln(e.found)}`:ne("live"):ne("no_picture"):ne(e?.single?"no_picture":"no_camera")}function uf(n,e,t){let[i,s]=[Math.round(e.width*t),Math.round(e.height*t)];n.width!==i&&(n.width=i),n.height!==s&&(n.height=s);let r=n.getContext("2d");return r.setTransform(t,0,0,t,0,0),r.clearRect(0,0,e.width,e.height),r}var pf=0;function Zo(n,e){pf+=1;let t=`typed-pose-${pf}`,i=R("input",{type:"text",autocomplete:"off",spellcheck:"false",id:t});return i.addEventListener("input",()=>n.choose({typed:i.value})),i.addEventListener("keydown",r=>{r.key==="Escape"&&i.blur(),!(r.key!=="Enter"||r.repeat)&&(r.preventDefault(),e())}),{element:R("div",{class:"typing labelled"},Me(R("label",{for:t}),"typed_pose"),i),input:i,update(r){let{columns:a=[],units:o=[]}=r.robot??{},c=l=>o[l]&&o[l]!==o[l+1]?` (${o[l]})`:"";Pe(i,"placeholder",a.map((l,u)=>l+c(u)).join(" ")),i.value!==n.choices.typed&&(i.value=n.choices.typed)}}}var mf=1200,kx=50;function Ox(){let n=null,e=-mf;return(t,i)=>(t===null||n===null?n=t:Math.abs(t-n)>kx*10**-i&&(n=t,e=performance.now()),performance.now()-e<mf)}function Bx(){let n=Ox(),[e,t,i,s]=[R("strong"),R("b"),R("span"),R("small")],r=R("div",{class:"digit"},R("dt",{},e,i,s),R("dd",{},t));return{element:r,update(a){Ne(r,"moved",a.now===null&&n(a.value,a.digits)),Ee(e,a.name),Ee(t,a.value===null?"–":a.value.toFixed(a.digits)),Ee(i,a.unit&&` ${a.unit}`),Ee(s,a.now===null?"":ne("now_at",{value:a.now.toFixed(a.digits)}))}}}function zx(n,e){let{robot:t,next:i,cell:s}=n,r=zt(n)?i:null,a=r??t??{},o=(e?a.joints_deg:a.numbers)??[],c=r&&!t?.typed?e?t?.joints_deg:t?.numbers:null,l=e?o.map((h,f)=>`J${f+1}`):a.columns,u=o.length||(l?.length??0),d=e?o.map((h,f)=>n.arm?.units?.[f]??"°"):a.units;return Ch(l,u,s?.notation,d).map((h,f)=>({...h,digits:e?2:h.digits,value:o[f]??null,now:c?.length===o.length?c[f]??null:null}))}function gf(n){let e=R("h2"),t=R("p",{class:"off"}),i=R("p",{class:"gain"}),s=R("dl",{class:"digits"}),r=ut(s,d=>d.key,Bx),a=R("p",{class:"joint-values"}),o=R("button",{type:"button"},Me(R("span"),"joints"));o.addEventListener("click",()=>n.choose({joints:!n.choices.joints}));let c=Ke("other_view",()=>il(n),{icon:"skip"}),l=Zo(n,()=>{n.state&&zt(n.state)&&Os(n.state)?Bs(n):ui(n)});return{element:R("section",{class:"pose"},R("div",{class:"top"},e,t),s,a,l.element,R("div",{class:"foot"},i,o,c)),update(d){let h=zt(d)?d.next:null;Ee(e,h?ne("next_view",{number:h.number??""}):ne("robot_now"));let f=h?ks(d):null;h&&!d.robot?.typed?Yt(t,Hx(d)):lt(t,d.step==="robot"?null:d.robot?.why),Ne(t,"there",f===!0),Ne(t,"away",f===!1);let g=typeof h?.before_mm=="number"&&typeof h.after_mm=="number";Ee(i,g?ne("gain",{before:tt(h?.before_mm),after:tt(h?.after_mm)}):"");let x=!!(h??d.robot)?.joints_deg?.length,m=zx(d,n.choices.joints&&x);r(m.map((p,v)=>({...p,key:`${v} ${p.name}`}))),Ne(s,"many",m.length>9),Ee(a,x&&!n.choices.joints?Vx(d):""),fe(o,x),Pe(o,"aria-pressed",String(n.choices.joints)),fe(c,!!h),l.update(d),fe(l.element,d.robot?.typed===!0&&(zt(d)||Xn(d)))}}}var Gx=1;function Vx(n){let e=(zt(n)?n.next:null)??n.robot,t=(i,s)=>`J${s+1} ${i.toFixed(Gx)} ${n.arm?.units?.[s]??"°"}`;return(e?.joints_deg??[]).map(t).join("  ")}function Hx(n){let e=n.next?.off;return!e||typeof e.mm!="number"?"":ks(n)?ne("at_view"):ne("away",{mm:tt(e.mm),deg:Vr(e.deg)})}function Wx(n,e){let t=R("span",{class:"number"}),i=Pt("check"),s=R("span",{class:"unseen"}),r=R("small"),a=R("button",{type:"button",class:"step"},R("span",{class:"sign","aria-hidden":"true"},t,i),R("span",{class:"what"},Me(R("b"),`step_${e}`),s,r));return a.addEventListener("click",o=>{o.detail>0&&a.blur(),Gr(n,e)}),{element:R("li",{},a),update(o){Ee(t,String(o.number));for(let l of["done","now","open","locked"])Ne(a,l,o.state===l);Ne(a,"proven",o.proven===!0),Pe(a,"aria-current",o.state==="now"&&"step"),Pe(a,"aria-disabled",o.state==="locked"&&"true");let c=o.state==="done"||o.state==="locked";fe(t,!c),fe(i,c),on(i,o.state==="locked"?"lock":"check"),Ee(s,` ${ne(`state_${o.state}`)} `),lt(r,o.proof,l=>Ut(l).replace(/\.$/,"")),Pe(a,"title",o.proof&&Ut(Ln(o.proof)))}}}function _f(n,e,t){bt(e,"steps");let i=R("strong"),s=R("small"),r=R("ol"),a=ut(r,d=>d.name,d=>Wx(n,d.name)),o=Ke("sound_off",()=>n.choose({muted:!n.choices.muted}),{icon:"sound",bare:!0}),c=o.querySelector("svg"),l=R("button",{type:"button"});l.addEventListener("click",()=>n.choose({language:Bi()==="en"?"de":"en"}));let u=Ke("keys",t,{icon:"keys",bare:!0});return e.append(R("div",{class:"brand"},i,s),r,R("div",{class:"tools"},o,l,u)),{element:e,update(d){Ee(i,d.title??"handeye"),Ee(s,d.folder),Pe(s,"title",d.folder),a((d.steps??[]).map((h,f)=>({...h,number:f+1}))),on(c,n.choices.muted?"mute":"sound"),bt(o,n.choices.muted?"sound_on":"sound_off",!0),Ee(l,Bi()==="en"?"DE":"EN"),bt(l,Bi()==="en"?"in_german":"in_english",!0),Pe(l,"lang",Bi()==="en"?"de":"en")}}}var bf=1e3,Xc=0;function Ii(n){Xc+=1;let[e,t]=[`number-${Xc}`,`number-label-${Xc}`],i=R("input",{type:"text",inputmode:"decimal",autocomplete:"off",id:e});function s(){let f=Number(i.value.trim().replace(",","."));return i.value.trim()!==""&&Number.isFinite(f)&&f>=n.least?f:null}let r=-bf;function a(){r=performance.now(),Pe(i,"aria-invalid",s()===null&&"true"),s()!==null&&n.changed()}function o(f){let g=Math.max(n.least,(s()??0)+f*n.step);i.value=String(Math.round(g*1e6)/1e6),a()}let c=(f,g)=>{let x=bt(R("button",{type:"button",class:"stepper","aria-describedby":t},g),f<0?"less":"more");return x.addEventListener("click",()=>o(f)),x};i.addEventListener("change",a);let l=n.unit?R("span",{class:"unit"},n.unit):null,u=n.buttons===!1?[i,l]:[c(-1,"−"),i,l,c(1,"+")],d=Me(R("label",{for:e,id:t}),n.label);return{element:R("div",{class:"number-field labelled"},d,R("div",{class:"row"},...u)),value:s,disable(f){for(let g of u)g&&"disabled"in g&&Pe(g,"disabled",f)},set(f){typeof f=="number"&&performance.now()-r>bf&&Dn(i,String(f));let g=i.value!==""&&s()===null;document.activeElement!==i&&Pe(i,"aria-invalid",g&&"true")}}}var Xx={count:1,id:1,length:.5,ratio:.05},qx={count:1,id:0,length:.01,ratio:.01};function Kx(n,e){if(n.kind==="dictionary"||n.kind==="family"){let s=n.kind==="family"?Fc:Ud,r=R("select",{},...s.map(a=>R("option",{value:a},a.replace("DICT_",""))));return r.addEventListener("change",e),r.value=String(n.initial),{element:Kn(n.label,r),value:()=>r.value,set:a=>typeof a=="string"&&s.includes(a)&&Dn(r,a),disable:a=>Pe(r,"disabled",a)}}let t=n.kind==="length"?{unit:"mm"}:{},i=Ii({label:n.label,...t,step:Xx[n.kind],least:qx[n.kind],changed:e});return i.set(Number(n.initial)),{...i,set:s=>i.set(typeof s=="number"?s:void 0)}}function xf(n){let e=R("select",{},...Object.entries(Xo).map(([d,{label:h}])=>Me(R("option",{value:d}),h))),t=new Map,i=R("div",{class:"forms"}),s=Pt("check"),r=R("p"),a=R("div",{class:"proof"},s,r),o=ns(),c=R("div",{class:"stack"},ft("in_picture",a),ft("board",o.element,Kn("target_kind",e),i,Me(R("p",{class:"hint"}),"measure_board")));e.addEventListener("change",()=>{u(e.value),n.redraw()});function l(d){let h=t.get(d);if(!h){let f=(Xo[d]?.fields??[]).map(g=>[g.name,Kx(g,()=>u(d))]);h={element:R("div",{class:"grid"},...f.map(([,{element:g}])=>g)),controls:f},t.set(d,h),i.append(h.element)}return h}function u(d){let h=l(d).controls.map(([m,{value:p}])=>[m,p()]);if(h.some(([,m])=>m===null))return;let f=n.state?.cell?.target,x={...f?.kind===d?f:{},kind:d,...Object.fromEntries(h)};n.send({do:"target",target:x})}return{element:c,update(d){let h=d.cell?.target,f=h&&Xo[h.kind]?h.kind:e.value;Dn(e,f);let g=qn(d);o.update(d),Pe(e,"disabled",g!==null);let x=l(f);for(let p of t.values())fe(p.element,p===x);for(let[p,v]of x.controls)v.set(h?.kind===f?h[p]:void 0),v.disable(g!==null);let m=!!d.camera?.found&&!d.camera?.missing;m?lt(r,d.camera?.found):d.camera?.missing?lt(r,d.camera.missing,Ut):Yt(r,ne("not_found_yet")),Ne(a,"good",m),Ne(a,"bad",!m),on(s,m?"check":"warning")}}}function $o(){let n=R("dl",{class:"facts"}),e=ut(n,({name:t})=>t,()=>{let t=Pt("check"),[i,s]=[R("dt"),R("dd")],r=R("div",{},t,i,s);return{element:r,update(a){Ee(i,a.name),a.said?lt(s,a.said):Yt(s,a.value||"–"),Ne(r,"good",a.good===!0),Ne(r,"bad",a.good===!1),on(t,a.good===!1?"warning":"check"),t.style.visibility=a.good===void 0?"hidden":"visible"}}});return{element:n,update(t){fe(n,t.length>0),e(t)}}}var vf=["fx","fy","cx","cy"],Yx=2;function Zx(n){let e=n.split(/[\s,;[\]]+/).filter(Boolean).map(Number);return e.every(Number.isFinite)?e:null}var yf=[["none","no_distortion",0],["brown-conrady","brown_conrady",12],["kannala-brandt","kannala_brandt",4]];function $x(n,e){let t=yf.find(([s])=>s===n)?.[2]??0;if(t===0)return{model:"none"};if(e.length>t)return null;let i=Array.from({length:t},(s,r)=>e[r]??0);return{model:n,coefficients:i}}function Jx(n){let e=n.model==="none"?[]:[...n.coefficients];for(;e.length&&e[e.length-1]===0;)e.pop();return e.join(" ")}function wf(n){let e=$o(),t=R("input",{type:"text",autocomplete:"off",placeholder:"k1 k2 p1 p2 k3"});t.addEventListener("change",()=>h());let i=R("select",{},...yf.map(([g,x])=>Me(R("option",{value:g}),x)));i.addEventListener("change",()=>{h(),n.redraw()});let s=ns(),r=Me(R("p",{class:"hint"}),"save_picture"),a=vf.map(g=>Ii({label:g,unit:"px",step:1,least:0,buttons:!1,changed:()=>h()})),o=R("div",{class:"grid"},...a.map(({element:g})=>g)),c=Kn("distortion",t),l=R("div",{class:"lens"},o,Kn("distortion_model",i),c,Me(R("p",{class:"hint"}),"intrinsics_hint")),u=!1,d=[!1,!0].map(g=>{let x=R("input",{type:"radio",name:"intrinsics"});x.addEventListener("change",()=>{u=g,g||n.send({do:"camera",intrinsics:null}),n.redraw()});let m=g?"intrinsics_known":"intrinsics_unknown",p=R("span",{},Me(R("b"),m),Me(R("small"),`${m}_what`));return{isKnown:g,input:x,element:R("label",{class:"choice plain"},x,p)}});function h(){let[g,x,m,p]=a.map(M=>M.value()),v=Zx(t.value),S=v&&$x(i.value,v);if(Pe(t,"aria-invalid",S===null&&"true"),!g||!x||m===null||m===void 0||p===null||p===void 0||!S)return;let w=n.state?.camera,T=n.state?.cell?.intrinsics,A=w?.width||(T?.width??0),_=w?.height||(T?.height??0);n.send({do:"camera",intrinsics:{width:A,height:_,fx:g,fy:x,cx:m,cy:p,distortion:S}})}return{element:R("div",{class:"stack"},ft("camera",e.element,r),ft("intrinsics",s.element,R("div",{class:"choices"},...d.map(g=>g.element)),l)),update(g){e.update(jx(g.camera)),fe(r,g.camera?.single===!0&&g.camera.uploads!==!0);let x=g.cell?.intrinsics,m=u||!!x,p=qn(g);for(let v of d)v.input.checked=v.isKnown===m,Ne(v.element,"chosen",v.input.checked),Pe(v.input,"disabled",p!==null&&!v.input.checked),Ne(v.element,"fixed",p!==null&&!v.input.checked);s.update(g);for(let v of a)v.disable(p!==null);for(let v of[i,t])Pe(v,"disabled",p!==null);fe(l,m),x&&Dn(i,x.distortion.model),fe(c,i.value!=="none"),Pe(t,"placeholder",i.value==="kannala-brandt"?"k1 k2 k3 k4":"k1 k2 p1 p2 k3"),x&&(a.forEach((v,S)=>v.set(x[vf[S]])),Dn(t,Jx(x.distortion)))}}}function jx(n){let e=n?.connected===!0,t=n?.single===!0,i=ne(t?"no_picture":"no_camera"),s=e?ne(t?"one_by_one":"streaming"):i,r=[{name:ne("pictures"),value:s,good:e||(t?void 0:!1)}];if(!e)return r;let a=n?.age_s,o=n?.delay_s;return[...r,{name:ne("size"),value:n?.width?`${n.width} × ${n.height??"?"} px`:null,good:void 0},...t?[{name:ne("newest"),said:n?.why,good:void 0}]:[{name:ne("age"),value:typeof a=="number"?`${a.toFixed(2)} s`:null,good:typeof a=="number"?a<Yx:void 0},{name:ne("rest"),said:n?.why,good:n?.stands}],...t?[]:[{name:ne("delay"),value:typeof o=="number"?`${o.toFixed(2)} s`:ne("not_known_yet"),good:void 0}]]}function Qx(n){let e=(o,c)=>_t("path",{d:o,class:c}),t=(o,c,l)=>_t("g",{transform:`translate(${o} ${c}) rotate(${l})`},e("M-7 -9h14v12h-14z","camera"),e("M-5 3L-20 40H20L5 3z","sight")),i=(o,c,l)=>_t("g",{transform:`translate(${o} ${c}) rotate(${l})`},e("M-22 0h44v6h-44z","board")),s=e("M24 92V58L52 26L86 34","arm"),r=e("M10 92h28","ground"),a=n==="eye-in-hand";return _t("svg",{viewBox:"0 0 150 104",class:"sketch","aria-hidden":"true"},r,s,a?t(90,42,-8):t(128,20,28),a?i(96,88,0):i(90,46,-40),e("M4 95h142","ground"))}function Sf(n){let t=["eye-in-hand","eye-to-hand"].map(o=>{let c=R("input",{type:"radio",name:"setup",value:o});c.addEventListener("change",()=>{n.send({do:"cell",setup:o})});let l=R("span",{},Me(R("b"),o.replaceAll("-","_")),Me(R("small"),`${o.replaceAll("-","_")}_what`));return{setup:o,input:c,element:R("label",{class:"choice"},c,Qx(o),l)}}),i=Ii({label:"tolerance",unit:"mm",step:.1,least:.01,changed:()=>{n.send({do:"cell",tolerance_mm:i.value()})}}),s=R("div",{role:"radiogroup",class:"choices"},...t.map(({element:o})=>o));bt(s,"where_is_camera");let r=ns();return{element:R("div",{class:"stack"},ft("where_is_camera",r.element,s),ft("how_accurate",i.element,Me(R("p",{class:"hint"}),"tolerance_what"))),update(o){for(let{setup:c,input:l,element:u}of t){let d=o.cell?.setup===c;l.checked!==d&&(l.checked=d),Pe(l,"disabled",qn(o)!==null&&!d),Pe(u,"data-setup",c),Ne(u,"chosen",d),Ne(u,"fixed",qn(o)!==null&&!d)}r.update(o),i.set(o.cell?.tolerance_mm)}}}var Mf={accepted:"check",rejected:"cross",undetermined:"warning"},ev=2e3;async function tv(n){try{return await navigator.clipboard.writeText(n),!0}catch{let e=R("textarea",{class:"unseen",readonly:!0});e.value=n,document.body.append(e),e.select();let t=document.execCommand("copy");return e.remove(),t}}function Rf(n){let e=Me(R("span"),"copy"),t=R("button",{type:"button",class:"copy"},Pt("copy"),e);return t.addEventListener("click",()=>{tv(n()).then(i=>{Me(e,i?"copied":"not_copied"),setTimeout(()=>Me(e,"copy"),ev)})}),t}var nv=["ros2-launch","urdf","opencv-yaml","matrix4x4","quaternion-xyzw"],Af=["npy"];function iv(n){let e=R("div",{role:"tablist"});bt(e,"exports");let t=R("code"),i=R("pre",{role:"tabpanel",id:"export-text",tabindex:0},t),s=R("button",{type:"button",class:"all"}),r=Rf(()=>d.get(c)??""),a=R("a",{class:"save",download:""},Pt("down"),Me(R("span"),"save")),o=[],c="",l=!1,u="",d=new Map,h=ut(e,S=>S,S=>{let w=R("button",{type:"button",role:"tab","aria-controls":"export-text"},S);return w.addEventListener("click",()=>g(S)),{element:w,update(){Pe(w,"aria-selected",String(S===c)),Pe(w,"tabindex",S===c?0:-1)}}});s.addEventListener("click",()=>{l=!l,n.redraw()}),e.addEventListener("keydown",S=>{let w=S.key==="ArrowRight"?1:S.key==="ArrowLeft"?-1:0,T=f();!w||!T.length||(S.preventDefault(),S.stopPropagation(),g(T[(T.indexOf(c)+w+T.length)%T.length]??""),e.querySelector('[aria-selected="true"]')?.focus())});function f(){let S=n.state?.cell?.notation??"",w=[S,...nv.filter(A=>A!==S)].filter(A=>o.includes(A)),T=o.filter(A=>!w.includes(A));return[...w,...T.filter(A=>l||A===c)]}function g(S){c=S,n.redraw()}async function x(S){let w=d;w.set(S,null);try{w.set(S,Af.includes(S)?"":await ah(Ef(S))),n.redraw()}catch{setTimeout(()=>w.delete(S),Tf)}}let m=R("div",{class:"top"},Me(R("h2"),"exports"),R("div",{class:"buttons"},r,a));return{element:R("section",{class:"card exports"},m,R("div",{class:"formats"},e,s),i),update(S){let w=JSON.stringify([S.assessed,S.result?.files]);w!==u&&([u,d]=[w,new Map]),o.length||v();let T=f();T.includes(c)||(c=T[0]??""),c&&!d.has(c)&&x(c),h(f());let A=Af.includes(c);Ee(t,A?ne("binary"):d.get(c)),fe(r,!A),Me(s,l?"fewer_formats":"more_formats"),Pe(s,"aria-expanded",String(l)),Pe(i,"aria-label",c),Pe(a,"href",Ef(c))}};async function v(){o=["…"];try{o=(await Fs("/api/formats")).map(({name:S})=>S),n.redraw()}catch{setTimeout(()=>o=[],Tf)}}}var Tf=2e3,Ef=n=>`/api/export?format=${encodeURIComponent(n)}`,sv=({translation_m:n,rotation_xyzw:e})=>[...n,...e].map(t=>t.toFixed(9)).join(" ");function rv(){let n=R("h2"),e=R("dl",{class:"transform"}),t=ut(e,([a])=>a,()=>{let[a,o]=[R("dt"),R("dd")];return{element:R("div",{},a,o),update([c,l]){Ee(a,c),Ee(o,l)}}}),i="",s=Rf(()=>i);return{element:R("section",{class:"card"},R("div",{class:"top"},n,s),e),update(a){let o=a.progress?.mount_from_camera;if(!o)return;i=sv(o),Ee(n,a.cell?.setup==="eye-to-hand"?"base_from_camera":"flange_from_camera");let[c,l]=[o.translation_m,o.rotation_xyzw];t([...c.map((u,d)=>["xyz"[d],`${(1e3*u).toFixed(3)} mm`]),...l.map((u,d)=>[`q${"xyzw"[d]}`,u.toFixed(6)])])}}}function Cf(n){let e=Pt("check"),t=R("h2"),i=R("p",{class:"headline"}),s=R("div",{class:"banner"},e,R("div",{},t,i)),r=rv(),a=iv(n),o=R("ul",{class:"files"}),c=ut(o,d=>d,d=>({element:R("li",{},R("code",{},d)),update:()=>{}})),l=R("section",{class:"card"},Me(R("h2"),"files"),o);return{element:R("div",{class:"result stack"},s,r.element,a.element,l),update(d){let h=d.result,f=h?.verdict??"undetermined";Ee(t,h?ne(`result_${f}`):ne("no_result")),h?av(i,d,f):Yt(i,ne("no_result_what")),on(e,Mf[f]??"warning");for(let x of Object.keys(Mf))Ne(s,x,h?f===x:!1);let g=!!h&&f==="accepted";fe(r.element,g&&!!d.progress?.mount_from_camera),fe(a.element,g),r.update(d),g&&a.update(d),c(h?.files??[]),fe(l,!!h)}}}function av(n,e,t){let{p95_mm:i,tolerance_mm:s,reasons:r,captures:a}=e.progress??{};e.verify?.agrees===!1?lt(n,e.say):t!=="accepted"?lt(n,r,Ut):Yt(n,ne("accepted_by",{error:tt(i),tolerance:tt(s),count:a??0}))}var ov=40,lv=10,Nr=["x","y","z"];function Pf(n){let e=(r,a)=>Nr.map((o,c)=>c===r?a:0),t=(r,a,o)=>{let c=o?ne("about_axis",{axis:Nr[r]??""}):Nr[r]??"",l=R("button",{type:"button"},`${a<0?"−":"+"} ${o?"↻ ":""}${Nr[r]}`);return l.setAttribute("aria-label",`${a<0?"−":"+"} ${c}`),l.addEventListener("click",u=>{u.detail>0&&l.blur();let[d,h]=o?[0,a*lv]:[a*ov,0];n.send({do:"jog",move_mm:e(r,d),turn_deg:e(r,h)})}),l},i=[!1,!0].flatMap(r=>[-1,1].flatMap(a=>Nr.map((o,c)=>t(c,a,r)))),s=ft("jog",Me(R("p",{class:"hint"}),"jog_what"),R("div",{class:"jog"},...i));return{element:s,update:r=>fe(s,!!r.virtual_cell)}}var cv=[["ur","Universal Robots: x y z rx ry rz"],["ur-rpy","Universal Robots: x y z roll pitch yaw"],["kuka","KUKA: X Y Z A B C"],["fanuc","FANUC: X Y Z W P R"],["abb","ABB: x y z q1 q2 q3 q4"],["yaskawa","Yaskawa: X Y Z Rx Ry Rz"],["kawasaki","Kawasaki: X Y Z O A T"],["staubli","Stäubli: x y z rx ry rz"],["doosan","Doosan: X Y Z A B C"],["denso","Denso: X Y Z RX RY RZ"],["quaternion-xyzw","x y z qx qy qz qw (m)"],["quaternion-wxyz","x y z qw qx qy qz (m)"],["matrix4x4","4 × 4 (m)"]];function If(n){let e=$o(),t=()=>R("select",{},...cv.map(([h,f])=>R("option",{value:h},f))),i=t();i.addEventListener("change",()=>{n.send({do:"notation",name:i.value})});let s=t(),r=Ke("reread",()=>{n.send({do:"notation",name:s.value,reread:!0})}),a=ft("typed_otherwise",Me(R("p",{class:"hint"}),"typed_otherwise_hint"),Kn("typed_in",s),r),o=Zo(n,()=>{ui(n)}),c=Ke("use_pose",()=>{ui(n)}),l=Pf(n),u=ft("type_pose",o.element,c);return{element:R("div",{class:"stack"},ft("robot",e.element,Kn("notation",i),Me(R("p",{class:"hint"}),"flange_hint")),u,a,l.element),update(h){let f=h.robot,g=f?.connected===!0;e.update([...f?.typed?[{name:ne("poses"),value:ne("from_pendant"),good:void 0}]:[{name:ne("poses"),value:ne(g?"streaming":"no_robot"),good:g}],{name:ne(f?.typed?"newest":"rest"),said:f?.why,good:f?.typed?void 0:f?.stands}]);let x=h.cell?.notation??"";x&&![...i.options].some(({value:m})=>m===x)&&i.append(R("option",{value:x},x)),Dn(i,x),o.update(h),fe(u,f?.typed===!0),fe(a,f?.typed===!0&&(h.captures?.length??0)>0),l.update(h)}}}var Vn=20,Df=60,hv=2e3;function uv(n,e){let t=n?.kind==="charuco";if(!t&&n?.kind!=="checkerboard")return null;let i=Number(t?n?.squares_x:Number(n?.columns)+1),s=Number(t?n?.squares_y:Number(n?.rows)+1);if(!(i>1&&s>1&&i<Df&&s<Df))return null;let r=[];for(let d=0;d<s;d+=1)for(let h=d%2;h<i;h+=2)r.push(_t("rect",{x:h*Vn,y:d*Vn,width:Vn,height:Vn}));let a=i-1,o=d=>({cx:(d%a+1)*Vn,cy:(Math.floor(d/a)+1)*Vn}),l=(e.touches??[]).filter(({placement:d})=>(d??null)===(e.placement??null)).map(({corner:d})=>_t("circle",{...o(d),r:6,class:"touched"})),u=_t("circle",{...o(e.corner),r:11,class:"mark"});return _t("svg",{viewBox:`-4 -4 ${i*Vn+8} ${s*Vn+8}`,class:"touch-board","aria-hidden":"true"},_t("rect",{x:0,y:0,width:i*Vn,height:s*Vn,class:"paper"}),_t("g",{class:"squares"},...r),...l,u)}function dv(n,e){let t=R("span"),i=R("b"),s=Ke("delete",()=>{n.send({do:"untouch",id:e})},{icon:"bin"});return{element:R("li",{},t,i,s),update(r){let a=String(r.corner);Ee(t,r.placement?ne("placed_corner",{id:r.placement,number:a}):ne("corner_number",{number:a})),Ee(i,typeof r.residual_mm=="number"?`${tt(r.residual_mm)} mm`:ne("no_residual"))}}}function fv(n,e){let t=R("span"),i=Ke("delete",()=>{n.send({do:"delete",id:e})},{icon:"bin"});return{element:R("li",{},t,R("b"),i),update:({touches:s})=>Ee(t,ne("placement_touches",{id:e,count:String(s??0)}))}}function pv(n){let e=R("ol",{class:"placements"}),t=ut(e,({id:o})=>o,({id:o})=>fv(n,o)),i=()=>n.state&&nl(n,n.state).run(),[s,r]=[Ke("place_again",i),Ke("lay_board",i)],a=ft("placements",Me(R("p",{class:"hint"}),"placement_what"),e,s,r);return{element:a,update(o,c){fe(a,o.lays===!0);let l=Ui(o)&&!c.taking;fe(s,l&&!c.virtual_cell),fe(r,l&&!!c.virtual_cell),t([...o.placements??[]].reverse())}}}function mv(n){let e=R("ul",{class:"deleted"}),t=ut(e,({id:i})=>i,({id:i})=>{let s=R("span"),r=Ke("restore",()=>{n.send({do:"restore",id:i})},{icon:"undo"});return{element:R("li",{},s,r),update:()=>Ee(s,ne("deleted_id",{id:i}))}});return{element:e,update:i=>t(i.filter(({id:s})=>/^[pt]/.test(s)))}}function Lf(n){let e=["tip_x","tip_y","tip_z"].map(S=>Ii({label:S,unit:"mm",step:1,least:-hv,buttons:!1,changed:v})),t=R("div",{class:"drawing"}),i=R("p",{class:"which"}),s=R("ol",{class:"touches"}),r=ut(s,({id:S})=>S,({id:S})=>dv(n,S)),a=mv(n),o=Ke("undo",()=>{n.send({do:"undo"})},{icon:"undo"}),c=ft("touches",s,a.element,o),l=pv(n),u=R("p",{class:"hint"}),d=ft("touch_next",i,t,u),h=ft("tip",Me(R("p",{class:"hint"}),"tip_hint"),R("div",{class:"grid"},...e.map(S=>S.element))),f=[l.element,d,c],g=R("div",{class:"stack"},h,...f),x="",m=!1;function p(S){S===m||h.contains(document.activeElement)||(m=S,g.replaceChildren(...S?[...f,h]:[h,...f]))}function v(){let[S,w,T]=e.map(A=>A.value());typeof S!="number"||typeof w!="number"||typeof T!="number"||n.send({do:"tip",in_flange_mm:[S,w,T]})}return{element:g,update(S){let w=Xn(S)?Fi(S):null;if(fe(g,!!w),!w)return;p(S.step==="verify"&&!!w.tip_mm),e.forEach((U,D)=>U.set(w.tip_mm?.[D])),l.update(w,S),Ee(i,ne("corner_number",{number:String(w.corner)})),Ee(u,ne(S.step==="verify"?"verify_touches_why":"touch_why")),fe(d,!w.lays||Ui(w));let T=w.touches??[];r([...T].reverse());let A=S.deleted??[];a.update(A),fe(o,!!S.can_undo),fe(c,T.length>0||A.some(({id:U})=>/^[pt]/.test(U)));let _=JSON.stringify([S.cell?.target,w.corner,w.placement,T.map(({corner:U})=>U)]);if(_===x)return;x=_;let M=uv(S.cell?.target,w);t.replaceChildren(...M?[M]:[]),fe(t,M!==null)}}}function gv(n,e){let t=R("span"),i=R("b"),s=Ke("delete",()=>{n.send({do:"delete",id:e})},{icon:"bin"});return{element:R("li",{},t,i,s),update(r){Ee(t,ne("view_number",{number:e})),Ee(i,typeof r.distance_mm=="number"?`${tt(r.distance_mm)} mm`:ne("no_residual"))}}}function _v(n){let t=["views","touches"].map(r=>{let a=R("input",{type:"radio",name:"verify-by",value:r});return a.addEventListener("change",()=>n.choose({by:r})),{by:r,input:a,element:R("label",{class:"choice"},a,Me(R("b"),`by_${r}`))}}),i=R("div",{role:"radiogroup",class:"choices pair"},...t.map(r=>r.element));bt(i,"verification");let s=R("p",{class:"hint"});return{group:i,what:s,update(){for(let{by:r,input:a,element:o}of t){let c=n.choices.by===r;a.checked!==c&&(a.checked=c),Ne(o,"chosen",c),Pe(o,"data-by",r)}Ee(s,ne(`by_${n.choices.by}_what`))}}}function Nf(n){let e=R("p",{class:"which verified"}),t=R("p",{class:"hint"}),i=R("p",{class:"hint"}),s=_v(n),r=R("ol",{class:"touches"}),a=ut(r,({id:l})=>l,({id:l})=>gv(n,l)),o=ft("verification_views",r);return{element:R("div",{class:"stack"},ft("verification",e,t,i,s.group,s.what),o),update(l){let{views:u=[],rms_mm:d,expected_mm:h,agrees:f,touch:g,touches_expected_mm:x}=l.verify??{};s.update(),fe(s.group,!!g),fe(e,typeof f=="boolean"),Ne(e,"contradicts",f===!1),Ee(e,ne(f?"verified_yes":"verified_no")),fe(t,typeof d=="number"),Ee(t,ne("verified_by_views",{rms:tt(d),expected:tt(h)})),fe(i,typeof x=="number"),Ee(i,ne("verified_by_touches",{rms:tt(g?.rms_mm),expected:tt(x)})),fe(o,n.choices.by==="views"&&u.length>0),a([...u].reverse())}}}var bv=1920,xv=1080;function vv(n){let e=document.createElement("canvas");return[e.width,e.height]=[n.videoWidth,n.videoHeight],e.getContext("2d")?.drawImage(n,0,0),new Promise(t=>e.toBlob(t,"image/png"))}function Ff(n){let e=R("input",{type:"file",accept:"image/*",class:"unseen","aria-hidden":"true",tabindex:-1}),t=R("video",{class:"preview",playsinline:!0});t.muted=!0;let i=R("p",{class:"hint bad",role:"status"}),s=Ke("choose_image",()=>e.click()),r=Ke("browser_camera",()=>{g()}),a=Ke("take_image",()=>{x()},{class:"take-image"}),o=Ke("camera_off",()=>m()),c=R("div",{class:"buttons"},s,r,a,o),l=ft("image",Me(R("p",{class:"hint"}),"upload_hint"),t,c,e,i),u=null,d=null;e.addEventListener("change",()=>{let p=e.files?.[0];e.value="",p&&f(p)}),l.addEventListener("dragover",p=>p.preventDefault()),l.addEventListener("drop",p=>{p.preventDefault();let v=p.dataTransfer?.files[0];v&&f(v)});function h(p){d=p,n.redraw()}async function f(p){try{await lh(p),h(null)}catch(v){h(v instanceof Wn?{said:v.problem.message}:{own:"image_not_sent"})}}async function g(){try{u=await navigator.mediaDevices.getUserMedia({video:{width:{ideal:bv},height:{ideal:xv}}}),t.srcObject=u,await t.play(),h(null)}catch{m(),h({own:"no_browser_camera"})}}async function x(){let p=await vv(t);p&&await f(p)}function m(){u?.getTracks().forEach(p=>p.stop()),[u,t.srcObject]=[null,null],n.redraw()}return{element:l,update(p){let v=p.camera?.uploads===!0;!v&&u&&m(),fe(l,v);let S=u!==null;fe(t,S),fe(r,!S),fe(a,S),fe(o,S),fe(i,d!==null),d&&"own"in d?Yt(i,ne(d.own)):lt(i,d?.said,Ut)}}}var Ge=uh(Qo),Ls=n=>document.getElementById(n),Kc=Qd(),jo=Ls("stage"),Yc=Ls("side"),Of=ff(Ge),yv=Zd(Ls("spoken")),wv=["cell","camera","robot","board","capture","touch","verify","result"],Uf=["robot","capture","touch","verify"],qc=["capture","touch","verify","result"],Bf=[[Of,wv],[Gd(Ge),Uf],[gf(Ge),Uf],[Cf(Ge),["result"]]],zf=[[Ff(Ge),["camera","board","capture","verify"]],[Sf(Ge),["cell"]],[wf(Ge),["camera"]],[If(Ge),["robot"]],[xf(Ge),["board"]],[Nf(Ge),["verify"]],[Lf(Ge),["touch","verify"]],[qo(Ge,"rejects"),qc],[Uh(Ge),["capture","result"]],[Oh(Ge),["capture","result"]],[qo(Ge,"changes-answer"),qc],[Hd(Ge),["capture","verify"]],[qo(Ge,"info"),qc]],Sv=[Kd(Ge,Ls("notices")),_f(Ge,Ls("rail"),()=>Kc.showModal()),jd(Ge,Ls("head"))];bt(jo,"stage");bt(Yc,"side");document.body.append(Kc);jo.append(...Bf.map(([{element:n}])=>n));Yc.append(...zf.map(([{element:n}])=>n));function Qo(){let n=Ge.state??Mv;Rh(Ge.choices.language??(navigator.language.startsWith("de")?"de":"en"));let e=n.step??"cell";document.body.dataset.step!==e&&(Yc.scrollTop=0),Pe(document.body,"data-step",e),Ne(document.body,"starting",Ge.state===null),Ne(jo,"large-cell",Ge.choices.large==="cell"),n.captures?.some(({id:t})=>t===Ge.choices.selected)||(Ge.choices.selected=null),Ne(jo,"looking",Ge.choices.selected!==null);for(let t of Sv)t.update(n);for(let[t,i]of[...Bf,...zf]){let s=i.includes(e);s?(t.element.dataset.seen!==e&&fe(t.element,!0),t.update(n)):fe(t.element,!1),t.element.dataset.seen=s?e:""}document.title=n.title?`${n.title} – handeye`:"handeye"}var Mv={version:0},Jo=!1,kf=null,Av=250;function Tv(n){if(Ge.state={...n,by:Ge.choices.by},Ge.lostSince=null,Ge.signedOut=!1,Jo)return;Jo=!0;let e=()=>{!Jo||!Ge.state||(Jo=!1,clearTimeout(i),cancelAnimationFrame(t),Yd(Ge,kf,Ge.state),yv(Ge.state),kf=Ge.state,Qo())},t=requestAnimationFrame(e),i=setTimeout(e,Av)}function Ev(n){n===null?Ge.lostSince=null:(Ge.lostSince??=performance.now(),Ge.signedOut=n instanceof Wn&&n.status===401),Qo()}for(let n of["pointerdown","keydown"])addEventListener(n,Wd);ef(Ge,Kc);Qo();ch(Tv,Ev);tf(()=>Ge.state!==null&&Ge.lostSince===null&&(Ge.state.step!=="result"||Ge.choices.selected!==null),Of.draw);})();
